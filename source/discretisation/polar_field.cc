// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/discretisation/polar_field.h>

#include <cmath>

namespace Crevasse
{
  using namespace dealii;

  Tensor<1, 2>
  PolarField::displacement(const Point<2> &local) const
  {
    const double theta = std::atan2(local[1], local[0]);
    Tensor<1, 2> u;
    for (const Term &term : terms)
      {
        const double angle = term.frequency * theta - phase;
        u[0] += term.cosine * std::cos(angle);
        u[1] += term.sine * std::sin(angle);
      }
    return std::pow(local.norm(), power) * u;
  }



  Tensor<2, 2>
  PolarField::gradient(const Point<2> &local) const
  {
    const double       r     = local.norm();
    const double       theta = std::atan2(local[1], local[0]);
    const Tensor<1, 2> radial({local[0] / r, local[1] / r});
    const Tensor<1, 2> tangential({-local[1] / r, local[0] / r});
    Tensor<1, 2>       along_r, along_theta;
    for (const Term &term : terms)
      {
        const double angle = term.frequency * theta - phase;
        along_r[0] += power * term.cosine * std::cos(angle);
        along_r[1] += power * term.sine * std::sin(angle);
        along_theta[0] -= term.frequency * term.cosine * std::sin(angle);
        along_theta[1] += term.frequency * term.sine * std::cos(angle);
      }
    return std::pow(r, power - 1.) * (outer_product(along_r, radial) +
                                      outer_product(along_theta, tangential));
  }



  PolarField
  williams_term(const unsigned int n, const double kappa, const CrackMode mode)
  {
    const double half = n / 2.;
    const double sign = (n % 2 == 0) == (mode == CrackMode::opening) ? 1. : -1.;
    return PolarField(half,
                      mode,
                      {{{half, kappa + half + sign, kappa - half - sign},
                        {half - 2., -half, half}}});
  }



  PolarField
  square_root_without_jump(const CrackMode mode)
  {
    // Derivative of the first term by κ, times κ + 1, minus that term.
    const double sign = mode == CrackMode::opening ? -1. : 1.;
    return PolarField(0.5,
                      mode,
                      {{{0.5, 0.5 - sign, 1.5 + sign}, {-1.5, 0.5, -0.5}}});
  }
} // namespace Crevasse
