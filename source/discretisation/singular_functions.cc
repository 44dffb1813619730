// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/discretisation/singular_functions.h>

#include <deal.II/base/exceptions.h>
#include <deal.II/base/numbers.h>

#include <cmath>

namespace Crevasse
{
  using namespace dealii;

  SingularFunctions
  make_singular_functions(const unsigned int     n,
                          const CrackTip        &tip,
                          const PlaneElasticity &elasticity,
                          const double           length)
  {
    Assert(n >= 1 && n <= 3, ExcInternalError());
    SingularFunctions functions{tip, {}, 0.};
    const double      kappa = elasticity.kappa();
    // The n-th term opens the lip by (κ + 1) r^{n/2}, up to its sign.
    const auto scaled = [&](PolarField field, const double power) {
      return field *= std::pow(length, -power) / (kappa + 1.);
    };
    functions.fields.push_back(scaled(williams_term(1, kappa), 0.5));
    if (n >= 2)
      functions.fields.push_back(scaled(square_root_without_opening(), 0.5));
    if (n >= 3)
      functions.fields.push_back(scaled(williams_term(3, kappa), 1.5));

    // 2μu = williams_term(1) has √(2π).
    functions.unit_stress_intensity = 2. * elasticity.shear_modulus() *
                                      std::sqrt(2. * numbers::PI / length) /
                                      (kappa + 1.);
    return functions;
  }
} // namespace Crevasse
