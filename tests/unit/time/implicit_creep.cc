// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

// Nonlinear creep over an implicit step at one point: the stress
// satisfies its equation, and its moduli are its derivative.

#include <crevasse/base/text.h>
#include <crevasse/material/creep_point.h>
#include <crevasse/material/voigt_matrix.h>

#include <crevasse_tests/tests.h>
#include <random>

using namespace Crevasse;

namespace
{
  /** A law, its name in the test, and its constants. */
  struct Law
  {
    std::string         name;
    const CreepLaw     &law;
    CreepLaw::Constants constants;
  };



  template <int dim>
  void
  steps_of(const VoigtMatrix<dim> &K, const Law &of)
  {
    constexpr double       k = 1.3;
    const VoigtMatrix<dim> H = isotropic_compliance<dim>(1., 0.5);
    const CreepPoint<dim>  law{&of.law,
                              of.constants,
                              RelaxationModes<dim>(H, K)};
    std::mt19937           generator(1);
    std::uniform_real_distribution<double> any(-1., 1.);
    double in_equation = 0., in_moduli = 0., asymmetry = 0., in_state = 0.;
    for (const double kappa : {0., 1e-3, 1., 1e6})
      for (int repeat = 0; repeat < 6; ++repeat)
        {
          const double     log_kappa = std::log(kappa);
          VoigtVector<dim> strain, change, known;
          for (unsigned int i = 0; i < n_stress_components<dim>; ++i)
            {
              // The last is nearly without a change of shape.
              strain[i] = (repeat < 5 ? 1e-2 : 1e-9) * any(generator) +
                          (repeat == 5 && i < 3 ? 1e-2 : 0.);
              change[i] = any(generator);
            }
          // Has hardened in any direction, or in that of the stress; or starts
          // from rest.
          if (of.law.hardens && repeat > 1)
            {
              known =
                law.rate(K * (repeat < 4 ? change : strain), {}, k).of_state;
              known *= std::pow(1e-3, 1. + of.constants.back()) /
                       ((known[0] + known[1] + known[2]) / 3.);
            }
          const auto stress = [&](const VoigtVector<dim> &e) {
            return law.relaxed_stress(e, known, k, log_kappa);
          };
          const VoigtVector<dim> s = stress(strain);
          const VoigtVector<dim> end =
            known + kappa / k * law.rate(s, known, k, kappa).of_state;
          // The creep of large κ is lost in e, not in s.
          const VoigtVector<dim> crept = of.law.hardens ? law.strain(end) : end;
          in_equation                  = std::max(in_equation,
                                 (s - k * (K * (strain - crept))).norm() /
                                   (s.norm() + (k * (K * crept)).norm()));
          if (of.law.hardens)
            {
              if (repeat < 5)
                in_state = std::max(in_state,
                                    (law.state(law.strains(end)) - end).norm() /
                                      (end.norm() + 1e-300));
              continue;
            }
          const double           h = 1e-5 * strain.norm();
          const VoigtMatrix<dim> C =
            law.relaxed_stiffness(s, known, k, log_kappa);
          const VoigtVector<dim> along = k * (C * change);
          const VoigtVector<dim> difference =
            stress(strain + h * change) - stress(strain - h * change);
          if (repeat < 5)
            in_moduli =
              std::max(in_moduli,
                       (difference / (2. * h) - along).norm() / along.norm());
          asymmetry = std::max(asymmetry, (C - transpose(C)).norm() / C.norm());
        }
    check_below(of.name + ", error of the equation", in_equation, 1e-11);
    if (of.law.hardens)
      return check_below(of.name + ", error of the strains", in_state, 1e-12);
    check_below(of.name + ", error of the moduli", in_moduli, 1e-4);
    check_below(of.name + ", asymmetry of the moduli", asymmetry, 1e-13);
  }



  std::vector<Law>
  all_laws()
  {
    const double     log_a = std::log(1e-7);
    std::vector<Law> laws;
    for (const double n : {1., 3., 8., 50.})
      laws.push_back(
        {"n = " + Text::from_number(n), power_law(), {{log_a, n}}});
    for (const double s_0 : {1e5, 10., 0.1}) // arguments up to 1e3
      laws.push_back({"s_0 = " + Text::from_number(s_0),
                      hyperbolic_sine(),
                      {{log_a, 3., s_0}}});
    for (const double m : {0.5, 2.})
      laws.push_back({"m = " + Text::from_number(m),
                      strain_hardening(),
                      {{std::log(1e-12), 3., m}}});
    return laws;
  }



  /** The derivatives of Ω by the stress and by the constants, relative to sf.
   */
  void
  potential_of(const Law &of)
  {
    constexpr double h       = 1e-5;
    double           in_rate = 0., in_slopes = 0.;
    for (const double s : {1e-3, 0.5, 5., 40., 500.})
      {
        const double log_s        = std::log(s);
        const auto   of_constants = [&](const CreepLaw::Constants &c) {
          return of.law.dual_potential(c, log_s).value;
        };
        const CreepLaw::Constants c    = of.constants;
        const auto [log_secant, slope] = of.law.response(c, log_s);
        const double sf                = std::exp(log_secant) * s * s;
        if (!(sf > 1e-200 && sf < 1e200))
          continue; // of steep laws
        const double step   = h / slope;
        const double change = of.law.dual_potential(c, log_s + step).value -
                              of.law.dual_potential(c, log_s - step).value;
        in_rate = std::max(in_rate, std::abs(change / (2. * step * sf) - 1.));
        for (std::size_t i = 0; i < of.law.parameters.size(); ++i)
          {
            const double        size = std::abs(c[i]) * h / slope;
            CreepLaw::Constants less = c, more = c;
            less[i] -= size;
            more[i] += size;
            const double exact = of.law.dual_potential(c, log_s).slopes[i];
            const double found =
              (of_constants(more) - of_constants(less)) / (2. * size);
            in_slopes =
              std::max(in_slopes, std::abs(found - exact) * size / h / sf);
          }
      }
    check_below(of.name + ", error of the potential's slope", in_rate, 1e-8);
    check_below(of.name + ", error of slopes by constants", in_slopes, 1e-7);
  }



  template <int dim>
  void
  steps_of(const std::string &name, const VoigtMatrix<dim> &K)
  {
    section(name);
    for (const Law &law : all_laws())
      steps_of<dim>(K, law);
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
  section("potentials");
  for (const Law &law : all_laws())
    potential_of(law);
  steps_of<2>("plane strain", isotropic_stiffness<2>(1e4, 0.3, false));
  steps_of<2>("plane stress", isotropic_stiffness<2>(1e4, 0.3, true));
  steps_of<2>("anisotropic", anisotropic<2>());
  steps_of<3>("three dimensions", isotropic_stiffness<3>(1e4, 0.3, false));
  steps_of<3>("three dimensions, anisotropic", anisotropic<3>());
}
