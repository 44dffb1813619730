// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/crack_tip/arc_field.h>

namespace Crevasse
{
  using namespace dealii;

  ArcField::ArcField(const CrackTip     &tip,
                     const InterfaceTip &interface,
                     const CrackMode     mode)
    : tip(tip)
    , interface(interface)
    , C((mode == CrackMode::opening ? Complex(1., 0.) : Complex(0., -1.)) /
        (std::sqrt(2. * numbers::PI) *
         (1. / interface.compliance[0] + 1. / interface.compliance[1])))
  {
  }



  ArcField::Complex
  ArcField::F(const Complex &Z, const bool is_below) const
  {
    double angle = std::arg(Z);
    if (is_below && angle > 0.5 * numbers::PI)
      angle -= 2. * numbers::PI;
    if (!is_below && angle < -0.5 * numbers::PI)
      angle += 2. * numbers::PI;
    const Complex log(std::log(std::abs(Z)), angle);
    return C * std::exp(-0.5 * log - Complex(0., interface.epsilon()) *
                                       (log - std::log(interface.length)));
  }



  ArcField::Gradients
  ArcField::at(const Point<2> &local, const bool is_below) const
  {
    const double  k = std::abs(tip.curvature);
    const Complex Z(local[0], local[1]);
    const Complex b(0., tip.curvature > 0. ? -1. : 1.);
    const Complex conj_z = std::conj(k * Z + b), image = 1. / conj_z;
    const Complex Phi   = F(Z, is_below) / interface.compliance[is_below];
    const Complex slope = Complex(-0.5, -interface.epsilon()) * Phi / (k * Z);
    const Complex Phi_e = -F(-b * std::conj(Z) / conj_z, !is_below) /
                          interface.compliance[!is_below];
    // z − ζ, without cancellation.
    const Complex apart = -2. * tip.curvature * tip.height(local) / conj_z;
    const Complex of_conj =
      -apart * std::conj(slope) - image * image * (Phi_e + std::conj(Phi));
    const PlaneElasticity &side = interface.sides[is_below];
    const double           mu   = 2. * side.shear_modulus;
    const Complex          of_z = (side.kappa() * Phi - std::conj(Phi)) / mu;
    const Complex sum = of_z + of_conj / mu, rest = of_z - of_conj / mu;
    const double  mean = 2. * Phi.real();

    const Tensor<2, 2> slopes(
      {{sum.real(), -rest.imag()}, {sum.imag(), rest.real()}});
    const Tensor<2, 2> stress({{mean + of_conj.real(), of_conj.imag()},
                               {of_conj.imag(), mean - of_conj.real()}});
    const Tensor<2, 2> R = tip.to_local();
    return {transpose(R) * slopes * R, transpose(R) * stress * R};
  }
} // namespace Crevasse
