// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

// Creep that is not linear over an implicit step at one point: the stress
// satisfies its equation, and its moduli are its derivative.

#include <crevasse/material/creep_point.h>
#include <crevasse/material/voigt_matrix.h>

#include <crevasse_tests/tests.h>
#include <random>

using namespace Crevasse;

namespace
{
  template <int dim>
  void
  steps_of(const std::string &name, const VoigtMatrix<dim> &K)
  {
    constexpr double       A = 1e-7, k = 1.3;
    const VoigtMatrix<dim> H = isotropic_compliance<dim>(1., 0.5);
    std::mt19937           generator(1);
    std::uniform_real_distribution<double> any(-1., 1.);
    double in_equation = 0., in_moduli = 0., asymmetry = 0.;
    for (const double n : {1., 3., 8., 50.})
      for (const double kappa : {0., 1e-3, 1., 1e6})
        for (int repeat = 0; repeat < 5; ++repeat)
          {
            const CreepPoint<dim> law{&power_law(),
                                      {std::log(A), n},
                                      RelaxationModes<dim>(H, K)};
            const double          log_kappa = std::log(kappa);
            VoigtVector<dim>      strain, change;
            for (unsigned int i = 0; i < n_stress_components<dim>; ++i)
              {
                // The last is nearly without a change of shape.
                strain[i] = (repeat < 4 ? 1e-2 : 1e-9) * any(generator) +
                            (repeat == 4 && i < 3 ? 1e-2 : 0.);
                change[i] = any(generator);
              }
            const auto stress = [&](const VoigtVector<dim> &e) {
              return law.relaxed_stress(e, k, log_kappa);
            };
            const VoigtVector<dim> s = stress(strain);
            // The creep of large κ is lost in e, not in s.
            const VoigtVector<dim> crept = kappa / k * law.rate(s, k).of_strain;
            in_equation                  = std::max(in_equation,
                                   (s - k * (K * (strain - crept))).norm() /
                                     (s.norm() + (k * (K * crept)).norm()));

            const double           h     = 1e-5 * strain.norm();
            const VoigtMatrix<dim> C     = law.relaxed_stiffness(s, log_kappa);
            const VoigtVector<dim> along = k * (C * change);
            const VoigtVector<dim> difference =
              stress(strain + h * change) - stress(strain - h * change);
            if (repeat < 4)
              in_moduli =
                std::max(in_moduli,
                         (difference / (2. * h) - along).norm() / along.norm());
            asymmetry =
              std::max(asymmetry, (C - transpose(C)).norm() / C.norm());
          }
    section(name);
    check_below("error of the equation", in_equation, 1e-11);
    check_below("error of the moduli", in_moduli, 1e-4);
    check_below("asymmetry of the moduli", asymmetry, 1e-13);
  }



  template <int dim>
  VoigtMatrix<dim>
  anisotropic()
  {
    VoigtMatrix<dim> K = isotropic_stiffness<dim>(1e4, 0.3, false);
    K[0][0] *= 3.;
    K[0][3] = K[3][0] = 500.;
    return K;
  }
} // namespace



void
implicit_creep()
{
  steps_of<2>("plane strain", isotropic_stiffness<2>(1e4, 0.3, false));
  steps_of<2>("plane stress", isotropic_stiffness<2>(1e4, 0.3, true));
  steps_of<2>("anisotropic", anisotropic<2>());
  steps_of<3>("three dimensions", isotropic_stiffness<3>(1e4, 0.3, false));
  steps_of<3>("three dimensions, anisotropic", anisotropic<3>());
}
