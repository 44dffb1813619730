// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/crack_tip/front_field.h>

namespace Crevasse
{
  using namespace dealii;

  namespace
  {
    /** Potential of unit K_III, f = 1/√(2πz), differentiated along the crack
     * and halved: 2μ u_t = 2 Im f, and the stress function is −Re ∫f dz. */
    std::complex<double>
    antiplane_potential(const FrontFrame &frame)
    {
      return 0.5 / std::sqrt(2. * numbers::PI *
                             std::complex<double>(frame.X, frame.Y));
    }
  } // namespace



  Tensor<1, 3>
  FrontFields::displacement(const FrontFrame &frame) const
  {
    if (mode == CrackMode::tearing)
      return Tensor<1, 3>({0., 0., 2. * antiplane_potential(frame).imag()});
    const BuecknerField        B(Point<2>(frame.X, frame.Y), mode, two_lips);
    const double               kappa = 3. - 4. * elasticity.poisson_ratio;
    const std::complex<double> u = 4. / (kappa + 1.) * (kappa * B.Phi - B.rest);
    return Tensor<1, 3>({u.real(), u.imag(), 0.});
  }



  FrontFields::Stress
  FrontFields::plane(const FrontFrame &frame) const
  {
    const BuecknerField B(Point<2>(frame.X, frame.Y), mode, two_lips);
    const double phi = B.airy, phi_X = B.along.real(), phi_Y = B.along.imag();
    const auto   f = weight.factor(frame.X), g = weight.factor(frame.Y);
    const double Q = f[0] * g[0], Q_X = f[1] * g[0], Q_Y = f[0] * g[1];
    const double k = frame.curvature / frame.metric(),
                 m = frame.normal_curvature / frame.metric();
    Stress tau;
    tau.rest[0][0] =
      2. * Q_Y * phi_Y + f[0] * g[2] * phi + 2. * m * (Q_Y * phi + Q * phi_Y);
    tau.rest[1][1] =
      2. * Q_X * phi_X + f[2] * g[0] * phi + 2. * k * (Q_X * phi + Q * phi_X);
    tau.rest[0][1] = -Q_X * phi_Y - Q_Y * phi_X - f[1] * g[1] * phi -
                     k * (Q_Y * phi + Q * phi_Y) - m * (Q_X * phi + Q * phi_X);
    tau.of_field[0][0] = Q * (B.mean - B.half_difference.real());
    tau.of_field[1][1] = Q * (B.mean + B.half_difference.real());
    tau.of_field[0][1] = Q * B.half_difference.imag();
    tau.along_front    = Q * elasticity.poisson_ratio * 2. * B.mean;
    return tau;
  }



  FrontFields::Stress
  FrontFields::antiplane(const FrontFrame &frame) const
  {
    const std::complex<double> z(frame.X, frame.Y);
    const std::complex<double> f_0 = antiplane_potential(frame);
    const std::complex<double> f_1 = -0.5 * f_0 / z;
    const double               A = -2. * (z * f_0).real(), A_X = -f_0.real(),
                 A_Y = f_0.imag();
    const auto   f = weight.factor(frame.X), g = weight.factor(frame.Y);
    const double Q = f[0] * g[0], Q_X = f[1] * g[0], Q_Y = f[0] * g[1];
    const double metric = frame.metric(), k = frame.curvature / metric;
    Stress       tau;
    tau.rest[0][2] =
      Q_X * A_Y + Q_Y * A_X + f[1] * g[1] * A - k * (Q_Y * A + Q * A_Y);
    tau.rest[1][2] = -2. * Q_X * A_X - f[2] * g[0] * A -
                     k * (Q_X * A + Q * A_X) + k * k * Q * A;
    tau.of_field[0][2] = Q * f_1.imag();
    tau.of_field[1][2] = Q * f_1.real();
    tau.of_slope[0][0] = -2. / metric * (Q_Y * A + Q * A_Y);
    tau.of_slope[0][1] = (Q_X * A + Q * A_X + k * Q * A) / metric;
    return tau;
  }



  std::pair<FrontField, FrontField>
  FrontFields::at(const FrontFrame &frame) const
  {
    const auto f = weight.factor(frame.X), g = weight.factor(frame.Y);
    if (f[0] == 0. || g[0] == 0.)
      return {};
    const Stress tau =
      mode == CrackMode::tearing ? antiplane(frame) : plane(frame);
    const Tensor<1, 3> u = displacement(frame);
    const double       Q = f[0] * g[0], Q_X = f[1] * g[0], Q_Y = f[0] * g[1];
    const double       metric = frame.metric(), k = frame.curvature / metric,
                 m = frame.normal_curvature / metric;

    SymmetricTensor<2, 3> strain, of_slope; // M (ε(w) − Q ε^B)
    strain[0][0]   = Q_X * u[0];
    strain[1][1]   = Q_Y * u[1];
    strain[0][1]   = 0.5 * (Q_X * u[1] + Q_Y * u[0]);
    strain[0][2]   = 0.5 * (Q_X - k * Q) * u[2];
    strain[1][2]   = 0.5 * Q_Y * u[2];
    strain[2][2]   = Q * (k * u[0] + m * u[1]);
    of_slope[0][2] = 0.5 * Q / metric * u[0];
    of_slope[1][2] = 0.5 * Q / metric * u[1];
    of_slope[2][2] = Q / metric * u[2];

    const double nu = elasticity.poisson_ratio, M = elasticity.modulus(mode);
    const auto   compliance = [&](const SymmetricTensor<2, 3> &s) { // M S s
      return M / elasticity.young_modulus *
             ((1. + nu) * s -
              nu * trace(s) * unit_symmetric_tensor<3, double>());
    };
    SymmetricTensor<2, 3> rest = tau.rest;
    rest[2][2] -= tau.along_front;
    return {{to_mesh(frame, strain - compliance(rest), 2.),
             M * to_mesh(frame, tau.of_field + tau.rest, 1.),
             Q * (u[0] * frame.ahead + u[1] * frame.inward +
                  u[2] * frame.tangent)},
            {to_mesh(frame, of_slope - compliance(tau.of_slope), 2.),
             M * to_mesh(frame, tau.of_slope, 1.),
             {}}};
  }



  VoigtVector<3>
  to_mesh(const FrontFrame            &frame,
          const SymmetricTensor<2, 3> &local,
          const double                 of_shear)
  {
    Tensor<2, 3> turn;
    turn[0]                   = frame.ahead;
    turn[1]                   = frame.inward;
    turn[2]                   = frame.tangent;
    const Tensor<2, 3> tensor = transpose(turn) * Tensor<2, 3>(local) * turn;
    VoigtVector<3>     vector;
    for (unsigned int i = 0; i < 3; ++i)
      for (unsigned int j = i; j < 3; ++j)
        vector[voigt_index<3>(i, j)] = (i == j ? 1. : of_shear) * tensor[i][j];
    return vector;
  }
} // namespace Crevasse
