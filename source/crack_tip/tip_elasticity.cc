// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/crack_tip/tip_elasticity.h>
#include <crevasse/material/voigt_matrix.h>

#include <deal.II/lac/lapack_full_matrix.h>

namespace Crevasse
{
  using namespace dealii;

  namespace
  {
    using Complex = std::complex<double>;

    /** Compliance a in the coordinates of the tip, of (11, 22, 12). */
    Tensor<2, 3>
    turned(const VoigtMatrix<2> &compliance, const CrackTip &tip)
    {
      Tensor<2, 3> a;
      for (unsigned int j = 0; j < 3; ++j)
        {
          std::array<double, 3> unit{};
          unit[j]                   = 1.;
          const auto         strain = compliance * to_mesh(tip, unit, 1.);
          const Tensor<2, 2> turn   = tip.to_local();
          Tensor<2, 2>       e;
          e[0][0] = strain[0];
          e[1][1] = strain[1];
          e[0][1] = e[1][0] = 0.5 * strain[3];
          e                 = turn * e * transpose(turn);
          a[0][j]           = e[0][0];
          a[1][j]           = e[1][1];
          a[2][j]           = 2. * e[0][1];
        }
      return a;
    }



    /** Roots μ with positive imaginary part, made to differ by rounding where
     * they do not: all formulas are divided differences. */
    std::array<Complex, 2>
    roots(const Tensor<2, 3> &a)
    {
      LAPACKFullMatrix<double> companion(4, 4);
      companion = 0.;
      for (unsigned int i = 0; i < 3; ++i)
        companion(i + 1, i) = 1.;
      const double coefficients[] = {a[1][1],
                                     -2. * a[1][2],
                                     2. * a[0][1] + a[2][2],
                                     -2. * a[0][2]};
      for (unsigned int i = 0; i < 4; ++i)
        companion(i, 3) = -coefficients[i] / a[0][0];
      companion.compute_eigenvalues();
      std::array<Complex, 2> mu;
      for (unsigned int i = 0, n = 0; i < 4 && n < 2; ++i)
        if (companion.eigenvalue(i).imag() > 0.)
          mu[n++] = companion.eigenvalue(i);
      constexpr double least = 1e-8;
      if (const Complex mean = 0.5 * (mu[0] + mu[1]);
          std::abs(mu[0] - mu[1]) < least * std::abs(mean))
        mu = {{(1. + 0.5 * least) * mean, (1. - 0.5 * least) * mean}};
      return mu;
    }



    /** 2 Re Σ xᵢ yᵢ */
    double
    twice_real(const std::array<Complex, 2> &x, const std::array<Complex, 2> &y)
    {
      return 2. * (x[0] * y[0] + x[1] * y[1]).real();
    }
  } // namespace



  AnisotropicTip::AnisotropicTip(const VoigtMatrix<2> &stiffness,
                                 const CrackTip       &tip)
    : compliance(inverse<2>(in_plane<2>(stiffness)))
    , a(turned(compliance, tip))
    , mu(roots(a))
  {
    for (const unsigned int i : {0, 1})
      {
        p[i] = a[0][0] * mu[i] * mu[i] + a[0][1] - a[0][2] * mu[i];
        q[i] = a[0][1] * mu[i] + a[1][1] / mu[i] - a[1][2];
      }
    // The lips move apart by 8 √(r/2π) L K, along Y and X.
    for (const unsigned int mode : {0, 1})
      {
        Tensor<1, 2> unit;
        unit[mode]       = 1.;
        const Pair c     = factors(unit);
        release[0][mode] = -(q[0] * c[0] + q[1] * c[1]).imag();
        release[1][mode] = -(p[0] * c[0] + p[1] * c[1]).imag();
      }
  }



  AnisotropicTip::Pair
  AnisotropicTip::factors(const Tensor<1, 2> &K) const
  {
    // 2 Σ cᵢ = K_I, 2 Σ μᵢ cᵢ = −K_II
    const Complex half = 0.5 / (mu[0] - mu[1]);
    return {{-half * (mu[1] * K[0] + K[1]), half * (mu[0] * K[0] + K[1])}};
  }



  AuxiliaryField
  AnisotropicTip::auxiliary(const CrackTip     &tip,
                            const CrackMode     mode,
                            const Point<2>     &local,
                            const SquareWeight &weight) const
  {
    const auto f = weight.factor(local[0]), g = weight.factor(local[1]);
    if (f[0] == 0. || g[0] == 0.)
      return {};
    const bool   is_T  = mode == CrackMode::constant;
    const double y     = tip.two_lips ? local[1] : std::max(local[1], 0.);
    const double share = tip.two_lips ? 0.5 : 1.;
    Tensor<1, 2> unit;
    if (!is_T)
      unit[mode == CrackMode::opening ? 0 : 1] = 1.;
    const Pair c = factors(invert(release) * unit);
    // For T a force along the crack, Fᵢ′ = dᵢ log zᵢ. All are differentiated
    // along the crack, so that G, G′, G″ stand for Fᵢ′ and so on.
    const double of_T = 0.5 / (numbers::PI * a[0][0]);
    Pair         G, first, second;
    for (const unsigned int i : {0, 1})
      {
        const Complex z(local[0] + mu[i].real() * y, mu[i].imag() * y);
        const Complex d = Complex(0., i == 0 ? of_T : -of_T) / (mu[0] - mu[1]);
        const Complex root = std::sqrt(z / (2. * numbers::PI));
        G[i]      = share * (is_T ? d * std::log(z) : 2. * c[i] * root);
        first[i]  = share * (is_T ? d / z : c[i] * root / z);
        second[i] = (is_T ? -1. : -0.5) * first[i] / z;
      }
    const Pair   one = {{1., 1.}}, squares = {{mu[0] * mu[0], mu[1] * mu[1]}};
    const double q_0 = f[0] * g[0], q_1 = f[1] * g[0], q_2 = f[0] * g[1];
    const double airy = twice_real(one, G), of_X = twice_real(one, first),
                 of_Y = twice_real(mu, first);
    const Tensor<1, 2> u({twice_real(p, first), twice_real(q, first)});
    const Tensor<1, 3> rest({2. * q_2 * of_Y + f[0] * g[2] * airy,
                             2. * q_1 * of_X + f[2] * g[0] * airy,
                             -q_1 * of_Y - q_2 * of_X - f[1] * g[1] * airy});
    const Tensor<1, 3> e = a * rest;

    AuxiliaryField field;
    field.of_stress[0] = to_mesh(tip,
                                 {{q_1 * u[0] - e[0],
                                   q_2 * u[1] - e[1],
                                   0.5 * (q_1 * u[1] + q_2 * u[0] - e[2])}},
                                 2.);
    field.of_force[0]  = q_0 * tip.global(u);
    field.of_strain    = to_mesh(tip,
                              {{rest[0] + q_0 * twice_real(squares, second),
                                   rest[1] + q_0 * twice_real(one, second),
                                   rest[2] - q_0 * twice_real(mu, second)}},
                              1.) /
                      modulus();
    return field;
  }



  bool
  TipElasticity::leaves_stress(const VoigtMatrix<2> &above,
                               const VoigtMatrix<2> &of_below) const
  {
    if (!has_only_release_rate())
      return PlaneElasticity::is_isotropic(
        PlaneElasticity::like_stiffness(above));
    // As a relaxation time makes it: H K = I/τ in the plane, on both sides.
    const double rate = (above * stiffness)[0][0];
    const auto   rest = [rate](VoigtMatrix<2> all) {
      for (const unsigned int c : {0, 1, 3})
        all[c][c] -= rate;
      for (unsigned int c = 0; c < n_stress_components<2>; ++c)
        all[2][c] = all[c][2] = 0.;
      return all.norm();
    };
    return std::max(rest(above * stiffness), rest(of_below * below())) <=
           1e-8 * std::abs(rate);
  }
} // namespace Crevasse
