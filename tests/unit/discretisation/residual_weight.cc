// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

// Weights of residuals: those of an isotropic stiffness are those of isotropic
// cells, and along the fibres of wood a traction counts as its stiffness says.

#include <crevasse/discretisation/residual_weight.h>

#include <crevasse_tests/tests.h>

using namespace Crevasse;
using dealii::Tensor;

namespace
{
  template <int dim>
  Tensor<1, dim>
  direction(const double x, const double y)
  {
    Tensor<1, dim> vector;
    vector[0] = x;
    vector[1] = y;
    return vector;
  }

  template <int dim>
  void
  isotropic(const std::string &name, const bool plane_stress)
  {
    const double              c = 3e-4;
    const ResidualWeight<dim> one(c),
      other(c, isotropic_stiffness<dim>(13000., 0.3, plane_stress));
    const auto n = direction<dim>(0.6, 0.8), t = direction<dim>(2., -5.);
    section(name);
    check_below("traction",
                std::abs(other.of_traction(t, n) / one.of_traction(t, n) - 1.),
                1e-12);
    check_below("force",
                std::abs(other.of_force(t) / one.of_force(t) - 1.),
                1e-12);
  }

  /** Plane stress with E₁ = 100, E₂ = 10, G = 4 and no contraction: on faces
   * across an axis Γ has the moduli, and the mean compliances are 1/(λ + μ) =
   * 1/E₁ + 1/E₂ and 1/μ = ½/E₁ + ½/E₂ + ½/G. */
  void
  wood()
  {
    VoigtMatrix<2> K;
    K[0][0] = 100.;
    K[1][1] = 10.;
    K[3][3] = 4.;
    const ResidualWeight<2> weight(1., K);
    const double mu = 2. / (0.01 + 0.1 + 0.25), tension = 1. / 0.11 + mu;
    const auto   x = direction<2>(1., 0.), y = direction<2>(0., 1.);
    section("wood");
    const auto check =
      [](const std::string &name, const double value, const double exact) {
        check_below(name, std::abs(value / exact - 1.), 1e-12);
      };
    check("along fibres that it stretches",
          weight.of_traction(x, x),
          tension / 100.);
    check("across fibres that it shears", weight.of_traction(y, x), mu / 4.);
    check("across fibres that it parts",
          weight.of_traction(y, y),
          tension / 10.);
    check("force along fibres", weight.of_force(x), (tension + mu) / 104.);
    check("force across fibres", weight.of_force(y), (tension + mu) / 14.);
  }
} // namespace



void
residual_weight();



void
residual_weight()
{
  isotropic<2>("plane stress", true);
  isotropic<2>("plane strain", false);
  isotropic<3>("space", false);
  wood();
}
