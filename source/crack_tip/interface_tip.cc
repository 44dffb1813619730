// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/crack_tip/interface_tip.h>

namespace Crevasse
{
  using namespace dealii;

  InterfaceTip::InterfaceTip(const Sides &stiffness, const double length)
    : stiffness(stiffness)
    , length(length)
    , sides{{PlaneElasticity(stiffness[0]), PlaneElasticity(stiffness[1])}}
    , compliance{{sides[0].kappa() / sides[0].shear_modulus +
                    1. / sides[1].shear_modulus,
                  sides[1].kappa() / sides[1].shear_modulus +
                    1. / sides[0].shear_modulus}}
  {
  }



  AuxiliaryField
  InterfaceTip::auxiliary(const CrackTip     &tip,
                          const CrackMode     mode,
                          const Point<2>     &local,
                          const SquareWeight &weight,
                          const bool          closed) const
  {
    using Complex       = BuecknerField::Complex;
    const bool is_below = std::signbit(local[1]);
    // Ahead of the tip σ₂₂ − iσ₁₂ = F (1/A + 1/B), of K²/G; half the field
    // counts, as at any tip with two lips.
    const Complex factor =
      (mode == CrackMode::opening ? Complex(2., 0.) : Complex(0., -2.)) /
      std::sqrt(2. * numbers::PI);
    const double  index = closed ? 0. : epsilon();
    const Complex power(-0.5, -index);
    const auto    F = [&](const Complex &z) {
      return factor / std::sqrt(z) *
             std::exp(Complex(0., -index) * std::log(z / length));
    };
    const Complex z(local[0], local[1]), conj_z = std::conj(z);
    const Complex Phi    = F(z) / compliance[is_below];
    const Complex Omega  = F(conj_z) / compliance[1 - is_below];
    const Complex first  = power * Phi / z;
    const Complex second = (power - 1.) * first / z;
    const Complex apart  = z - conj_z;
    // The auxiliary fields are derivatives along the crack.
    BuecknerField field;
    field.Phi  = Phi;
    field.rest = Omega + apart * std::conj(first);
    field.airy =
      ((Phi * z + Omega * conj_z) / (power + 1.) + apart * std::conj(Phi))
        .real();
    field.along           = Phi + field.rest;
    field.mean            = 2. * first.real();
    field.half_difference = std::conj(power * Omega / conj_z + first) +
                            std::conj(apart) * second - field.mean;

    const PlaneElasticity &side = sides[is_below];
    AuxiliaryField         all(tip, local, weight, field), scaled;
    scaled.of_stress[0] = (all.of_stress[0] + side.kappa() * all.of_stress[1]) /
                          (2. * side.shear_modulus);
    scaled.of_force[0] = (all.of_force[0] + side.kappa() * all.of_force[1]) /
                         (2. * side.shear_modulus);
    scaled.of_strain = all.of_strain / modulus();
    return scaled;
  }



  double
  contact_zone(const ContactBoundary<2> &lip,
               const CrackTip           &tip,
               const State              &state)
  {
    double      closed = 0., open = std::numeric_limits<double>::max();
    const auto  states = lip.states(state.displacement, state.contact_forces);
    const auto &nodes  = lip.basis.nodes;
    const auto  look   = [&](const bool at_closed, const auto &f) {
      for (std::size_t i = 0; i < states.size(); ++i)
        if (const Point<2> local = tip.local(nodes[i].point);
            nodes[i].has_unknown() && states[i].is_closed == at_closed &&
            local[0] < 0. && tip.is_on_curve(local))
          f(tip.length_to(local));
    };
    look(false, [&](const double r) { open = std::min(open, r); });
    look(true, [&](const double r) {
      if (r < open)
        closed = std::max(closed, r);
    });
    return closed;
  }



  ContactForces
  forces_beyond(const double              distance,
                const ContactBoundary<2> &lip,
                const CrackTip           &tip,
                const ContactForces      &forces)
  {
    ContactForces beyond = forces;
    for (std::size_t i = 0; i < lip.nodes.size(); ++i)
      if (lip.nodes[i].point.distance(tip.position) <= (1. + 1e-8) * distance)
        beyond.normal[i] = 0.;
    return beyond;
  }
} // namespace Crevasse
