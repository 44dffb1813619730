// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/problems.h>
#include <crevasse/material/phi_functions.h>

#include <cmath>

namespace Crevasse
{
  using namespace dealii;

  template <int dim>
  PhiFunctions<dim>
  decay_functions(const VoigtMatrix<dim> &rate)
  {
    const double size = rate.norm();
    if (!std::isfinite(size))
      throw NumericalError(
        "The relaxation of a material over a step is not finite: a step is "
        "too many relaxation times long. Take shorter steps or slower flow.");
    // Below ½ the series has all its digits after 14 terms.
    int doublings = 0;
    if (size > 0.5)
      doublings = std::ilogb(size) + 2;
    const VoigtMatrix<dim> z = -std::ldexp(1., -doublings) * rate;

    VoigtMatrix<dim> identity;
    for (unsigned int i = 0; i < n_stress_components<dim>; ++i)
      identity[i][i] = 1.;

    // φ₂ = Σ zⁿ/(n+2)!, by Horner's rule.
    constexpr unsigned int terms = 14;
    PhiFunctions<dim>      phi;
    for (unsigned int n = terms; n > 0; --n)
      phi.second = (identity + z * phi.second) / (n + 1.);
    phi.first                    = identity + z * phi.second;
    VoigtMatrix<dim> exponential = identity + z * phi.first;

    for (int n = 0; n < doublings; ++n)
      {
        phi.second = 0.25 * (exponential * phi.second + phi.first + phi.second);
        phi.first  = 0.5 * (exponential * phi.first + phi.first);
        exponential = exponential * exponential;
      }
    return phi;
  }



  template PhiFunctions<2>
  decay_functions(const VoigtMatrix<2> &);
  template PhiFunctions<3>
  decay_functions(const VoigtMatrix<3> &);
} // namespace Crevasse
