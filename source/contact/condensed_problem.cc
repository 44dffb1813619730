// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/problems.h>
#include <crevasse/contact/condensed_problem.h>

#include <cmath>
#include <limits>
#include <numeric>
#include <set>

namespace Crevasse
{
  using namespace dealii;

  CondensedProblem::CondensedProblem(const LAPACKFullMatrix<double> &stiffness,
                                     const LipVector                &sign,
                                     const LipVector                &gap,
                                     const Extrapolation &extrapolation)
    : ProblemOnLip(stiffness)
    , closed(stiffness.m(), false)
    , n(stiffness.m())
    , sign(sign)
    , gap(gap)
    , extrapolation(extrapolation)
  {
  }



  unsigned int
  CondensedProblem::solve(const LipVector &loads, LipVector &displacement)
  {
    // Nodes with neither force nor opening would change forever if values that
    // are negative by rounding changed them.
    constexpr double noise = 100. * std::numeric_limits<double>::epsilon();
    std::set<Set>    seen;
    bool             one_by_one = false;
    for (unsigned int n_sets = 1;; ++n_sets)
      {
        Set next = next_set(loads, displacement, one_by_one ? noise : 0.);
        if (next == closed)
          return n_sets;
        if (n_sets > 100 * (n + 10))
          throw NumericalError(
            "The contact problem of " + std::to_string(n) +
            " lip nodes did not converge within " + std::to_string(n_sets) +
            " active sets: its stiffness is too ill-conditioned. Check the "
            "moduli of [Material] and the mesh, or try [Contact] Solver = "
            "active set.");
        if (!one_by_one && !seen.insert(closed).second)
          {
            ++rescues;
            one_by_one = true;
          }
        if (one_by_one)
          {
            unsigned int last = n - 1;
            while (next[last] == closed[last])
              --last;
            closed[last].flip();
            continue;
          }
        if (extrapolation)
          {
            Set further = next;
            extrapolation(closed, further);
            if (seen.count(further) == 0)
              next = std::move(further);
          }
        closed = std::move(next);
      }
  }



  double
  CondensedProblem::product_in_row(const unsigned int i,
                                   const LipVector   &v) const
  {
    const double *const row = &factor.matrix(0, i); // a column: it is symmetric
    return std::inner_product(v.begin(), v.end(), row, 0.);
  }



  CondensedProblem::Set
  CondensedProblem::next_set(const LipVector &loads,
                             LipVector       &displacement,
                             const double     rounding)
  {
    displacement  = 0.;
    bool has_gaps = false;
    for (unsigned int i = 0; i < n; ++i)
      if (closed[i])
        {
          displacement(i) = sign(i) * gap(i);
          has_gaps        = has_gaps || gap(i) != 0.;
        }
    on_open = loads;
    if (has_gaps)
      for (unsigned int i = 0; i < n; ++i)
        if (!closed[i])
          on_open(i) -= product_in_row(i, displacement);
    Set next = closed;
    next.flip();
    factor.choose(next);
    factor.solve(on_open);
    displacement += on_open;

    // Openings vanish on the set, forces off it: the sign of one number
    // decides. With both zero, a node keeps its state.
    const double largest = displacement.linfty_norm();
    for (unsigned int i = 0; i < n; ++i)
      if (closed[i])
        {
          const double size =
            std::abs(loads(i)) + factor.matrix(i, i) * largest;
          const double force =
            sign(i) * (product_in_row(i, displacement) - loads(i));
          next[i] = force >= -rounding * size;
        }
      else
        next[i] = sign(i) * displacement(i) - gap(i) < -rounding * largest;
    return next;
  }
} // namespace Crevasse
