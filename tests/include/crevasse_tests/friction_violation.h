// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_tests_friction_violation_h
#define crevasse_tests_friction_violation_h

#include <crevasse/contact/coulomb_law.h>
#include <crevasse/contact/friction_problem.h>

#include <algorithm>
#include <cmath>

/** The largest violation of the conditions of a FrictionProblem: forces
 * relative to the largest |c| or |Σ_ii q_i|, jumps to the largest |q_i| or |c_i
 * / Σ_ii|. */
inline double
violation(const Crevasse::FrictionProblem &lip,
          const dealii::Vector<double>    &loads,
          const dealii::Vector<double>    &jumps)
{
  const auto &A     = lip.factor.matrix;
  double      force = 1e-300, jump = 1e-300;
  for (unsigned int i = 0; i < loads.size(); ++i)
    {
      force =
        std::max({force, std::abs(loads(i)), std::abs(A(i, i) * jumps(i))});
      jump = std::max({jump, std::abs(jumps(i)), std::abs(loads(i) / A(i, i))});
    }
  dealii::Vector<double> forces(loads.size());
  A.vmult(forces, jumps);
  forces -= loads;
  double worst = 0.;
  for (unsigned int i = 0; i < lip.pairs.size(); ++i)
    {
      const auto          &pair    = lip.pairs[i];
      const double         opening = (jumps(pair.normal) - pair.gap) / jump;
      const double         normal  = forces(pair.normal) / force;
      dealii::Tensor<1, 2> g, slip;
      for (const unsigned int c : {0, 1})
        if (pair.has(c))
          {
            const unsigned int T = pair.tangents[c];
            g[c]                 = forces(T) / force;
            slip[c] = (jumps(T) - lip.increment.reference[c][i]) / jump;
          }
      const double limit = lip.increment.coefficients[i] * std::max(normal, 0.);
      worst              = std::max({worst,
                                     std::abs(std::min(normal, opening)),
                                     Crevasse::violation_of_friction(g, limit, slip)});
    }
  return worst;
}

#endif
