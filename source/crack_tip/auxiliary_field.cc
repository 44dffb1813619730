// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/crack_tip/auxiliary_field.h>

#include <deal.II/base/numbers.h>

#include <algorithm>

namespace Crevasse
{
  using namespace dealii;

  namespace
  {
    using Complex = BuecknerField::Complex;

    Tensor<1, 2>
    to_mesh(const CrackTip &tip, const Complex &u)
    {
      return tip.global(Tensor<1, 2>({u.real(), u.imag()}));
    }
  } // namespace



  VoigtVector<2>
  to_mesh(const CrackTip              &tip,
          const std::array<double, 3> &t,
          const double                 of_shear)
  {
    const Tensor<2, 2> turn = tip.to_local();
    Tensor<2, 2>       local;
    local[0][0] = t[0];
    local[1][1] = t[1];
    local[0][1] = local[1][0] = t[2];
    const Tensor<2, 2> tensor = transpose(turn) * local * turn;
    VoigtVector<2>     vector;
    vector[0] = tensor[0][0];
    vector[1] = tensor[1][1];
    vector[3] = of_shear * tensor[0][1];
    return vector;
  }



  BuecknerField::BuecknerField(const Point<2> &local,
                               const CrackMode mode,
                               const bool      two_lips)
  {
    // Muskhelishvili's potentials: φ = √z/√(2π) and ψ = φ/2 have K_I = 1,
    // φ = −i √z/√(2π) and ψ = −3/2 φ have K_II = 1, and lips without traction.
    // Differentiated along the crack they are Φ = φ′ and Ψ = 3/2 Φ or −½ Φ.
    // T has Φ = −1/(2πz) and Ψ = 0, a force at the tip differentiated. The
    // stress function vanishes on the lips.
    const bool    is_T  = mode == CrackMode::constant;
    const double  n     = mode == CrackMode::opening
                            ? 1.5
                            : (mode == CrackMode::sliding ? -0.5 : 0.); // Ψ/Φ
    const double  power = is_T ? -1. : -0.5; // power of z in Φ
    const Complex unit_factor =
      (mode == CrackMode::sliding ? Complex(0., -1.) : Complex(1., 0.)) *
      (two_lips ? 0.5 : 1.);
    const Complex z(local[0], two_lips ? local[1] : std::max(local[1], 0.));
    Phi                  = is_T ? -unit_factor * 0.5 / (numbers::PI * z)
                                : unit_factor * 0.5 / std::sqrt(2. * numbers::PI * z);
    const Complex slope  = power * Phi / z;
    const Complex second = (power - 1.) * slope / z;
    rest                 = z * std::conj(slope) + n * std::conj(Phi);
    airy                 = (std::conj(z) * Phi + 2. * n * z * Phi).real() -
           (is_T ? (z * Phi).real() : 0.);
    along           = Phi + rest;
    mean            = 2. * slope.real();
    half_difference = std::conj(z) * second + n * slope;
  }



  AuxiliaryField::AuxiliaryField(const CrackTip      &tip,
                                 const Point<2>      &local,
                                 const SquareWeight  &weight,
                                 const BuecknerField &field)
  {
    const auto f = weight.factor(local[0]), g = weight.factor(local[1]);
    if (f[0] == 0. || g[0] == 0.)
      return;
    const auto &[Phi, rest, airy, along, mean, half_difference] = field;

    const double q = f[0] * g[0], q_1 = f[1] * g[0], q_2 = f[0] * g[1];
    const std::array<double, 3> rest_of_tau = {
      {2. * q_2 * along.imag() + f[0] * g[2] * airy,
       2. * q_1 * along.real() + f[2] * g[0] * airy,
       -q_1 * along.imag() - q_2 * along.real() - f[1] * g[1] * airy}};
    const auto strain = [&](const Complex &u) { // strain sym(∇q ⊗ u)
      return std::array<double, 3>{{q_1 * u.real(),
                                    q_2 * u.imag(),
                                    0.5 * (q_1 * u.imag() + q_2 * u.real())}};
    };
    const double                trace = rest_of_tau[0] + rest_of_tau[1];
    const std::array<double, 3> unit  = {{trace, trace, 0.}};
    of_stress                         = {
                              {to_mesh(tip, unit, 2.) * 0.75 - to_mesh(tip, strain(rest), 2.) -
                                 to_mesh(tip, rest_of_tau, 2.),
                               to_mesh(tip, strain(Phi), 2.) - to_mesh(tip, unit, 2.) * 0.25}};
    of_force  = {{-q * to_mesh(tip, rest), q * to_mesh(tip, Phi)}};
    of_strain = to_mesh(tip,
                        {{rest_of_tau[0] + q * (mean - half_difference.real()),
                          rest_of_tau[1] + q * (mean + half_difference.real()),
                          rest_of_tau[2] + q * half_difference.imag()}},
                        1.);
  }



  void
  AuxiliaryField::add(const double factor, const AuxiliaryField &other)
  {
    for (const unsigned int k : {0, 1})
      {
        of_stress[k] += factor * other.of_stress[k];
        of_force[k] += factor * other.of_force[k];
      }
    of_strain += factor * other.of_strain;
  }
} // namespace Crevasse
