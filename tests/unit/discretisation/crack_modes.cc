// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

// The interaction integral at a tip with two lips: it finds K_I, K_II and T,
// each alone, in exact stress fields, whatever the direction of the crack.

#include <crevasse/crack_tip/growth_direction.h>
#include <crevasse/crack_tip/interaction_integral.h>

#include <complex>
#include <crevasse_tests/slit_square.h>
#include <crevasse_tests/tests.h>

using namespace Crevasse;

namespace
{
  using Complex = std::complex<double>;

  constexpr double pi = dealii::numbers::PI;

  /** Terms of Williams' series around a tip with two lips. */
  struct ExactStress
  {
    double  K_I, K_II, T;
    Complex next; ///< of z^{3/2} in φ

    /** In the coordinates of the tip. */
    dealii::Tensor<2, 2>
    operator()(const dealii::Point<2> &local) const
    {
      // φ = a z^{n/2} with odd n leaves the lips free with
      // ψ = (ā − n/2 a) z^{n/2}.
      const Complex        z(local[0], local[1]), root = std::sqrt(z);
      const Complex        a     = Complex(K_I, -K_II) / std::sqrt(2. * pi);
      const Complex        b     = std::conj(a) - 0.5 * a;
      const Complex        c     = std::conj(next) - 1.5 * next;
      const Complex        phi_1 = 0.5 * a / root + 1.5 * next * root;
      const Complex        phi_2 = -0.25 * a / (z * root) + 0.75 * next / root;
      const Complex        psi_1 = 0.5 * b / root + 1.5 * c * root;
      const double         mean = 2. * phi_1.real(); // ½ (σ₁₁ + σ₂₂)
      const Complex        half_difference = std::conj(z) * phi_2 + psi_1;
      dealii::Tensor<2, 2> stress;
      stress[0][0] = mean - half_difference.real() + T;
      stress[1][1] = mean + half_difference.real();
      stress[0][1] = stress[1][0] = half_difference.imag();
      return stress;
    }
  };



  Scene
  cracked_scene()
  {
    Scene scene;
    scene.boundary.clamped       = "0";
    scene.boundary.symmetry      = "none";
    scene.boundary.loaded        = "none";
    scene.boundary.contact       = "none";
    scene.boundary.open_crack    = "none";
    scene.boundary.crack         = "1";
    scene.boundary.fixed_points  = "none";
    scene.material.young_modulus = "1";
    scene.material.poisson_ratio = "0.3";
    scene.material.viscosity     = ViscosityType::none;
    scene.discretisation.degree  = 2;
    return scene;
  }



  /** K_I, K_II and T of a stress with this pressure on the lips. */
  template <typename Stress>
  std::array<double, 3>
  intensities(const Body<2>       &body,
              const PointGeometry &points,
              const TipRegion     &region,
              const Stress        &stress_at,
              const double         pressure)
  {
    const dealii::Tensor<2, 2> turn = region.tip.to_local();
    Vector                     stress;
    body.points.initialize(stress);
    for (std::size_t p = 0; p < points.location.size(); ++p)
      {
        const dealii::Tensor<2, 2> s =
          transpose(turn) * stress_at(region.tip.local(points.location[p])) *
          turn;
        VoigtVector<2> voigt;
        voigt[0] = s[0][0];
        voigt[1] = s[1][1];
        voigt[3] = s[0][1];
        QuadratureField<2>::set(stress,
                                p * QuadratureField<2>::n_components,
                                voigt);
      }
    ContactForces forces;
    for (const auto &node : body.lip.nodes)
      forces.normal.push_back(pressure * node.weight);
    const double          size = region.largest_radius();
    std::array<double, 3> K;
    const PlaneElasticity elasticity(body.law.stiffness.at(
      Place<2>{region.tip.position, 0., 0., dealii::types::material_id(0)}));
    unsigned int          of_mode = 0;
    for (const CrackMode mode :
         {CrackMode::opening, CrackMode::sliding, CrackMode::constant})
      K[of_mode++] =
        InteractionIntegral(
          body, points, region, mode, LoadParameters(), {size, size, false})
          .of_uniform_body(stress, forces, elasticity.kappa());
    return K;
  }



  void
  check_exact_stress(const unsigned int degrees)
  {
    const std::string   name  = std::to_string(degrees) + " degrees";
    const Scene         scene = cracked_scene();
    const Body<2>       body(scene,
                       slit_square(degrees * pi / 180., is_full() ? 5 : 4));
    const PointGeometry points(body.space, body.points);
    const auto tips = find_crack_tips(body.space.mesh(), body.space.roles);
    check(name + ": one tip with two lips, at the centre, straight ahead",
          tips.size() == 1 && tips[0].two_lips &&
            tips[0].position.norm() < 1e-12 &&
            (tips[0].ahead -
             dealii::Tensor<1, 2>(
               {-std::sin(degrees * pi / 180.), std::cos(degrees * pi / 180.)}))
                .norm() < 1e-12);
    const TipRegion region(body.space, tips[0]);
    check_below(name + ": the region ends at the sides of the square",
                std::abs(region.largest_radius() - 1.),
                1e-12);

    constexpr double accuracy    = 2e-3;
    const auto       check_found = [&](const std::string &of,
                                 const ExactStress &stress) {
      const auto [K_I, K_II, T] = intensities(body, points, region, stress, 0.);
      check_below(name + ": " + of + ", error of K_I",
                  std::abs(K_I - stress.K_I),
                  accuracy);
      check_below(name + ": " + of + ", error of K_II",
                  std::abs(K_II - stress.K_II),
                  accuracy);
      check_below(name + ": " + of + ", error of T",
                  std::abs(T - stress.T),
                  accuracy);
    };
    check_found("mode I", {1., 0., 0., 0.});
    check_found("mode II", {0., 1., 0., 0.});
    check_found("both, T and more", {2., -1.5, 3., {0.4, -0.7}});
    const auto [K_I, K_II, T] = intensities(
      body,
      points,
      region,
      [](const dealii::Point<2> &) {
        dealii::Tensor<2, 2> pressed;
        pressed[0][0] = pressed[1][1] = -1.;
        return pressed;
      },
      1.);
    check_below(name + ": pressure all around, K_I", std::abs(K_I), accuracy);
    check_below(name + ": pressure all around, K_II", std::abs(K_II), accuracy);
    check_below(name + ": pressure all around, T", std::abs(T), accuracy);
  }



  /** The direction of the largest hoop stress, against a search. */
  void
  check_growth_direction()
  {
    double worst_angle = 0., worst_intensity = 0.;
    for (const double phase : {-1.5, -0.7, 0., 0.3, 1.1, 1.5707})
      {
        const double          K_I = std::cos(phase), K_II = std::sin(phase);
        const GrowthDirection direction(K_I, K_II);
        double                best = 0., at = 0.;
        for (double theta = -3.; theta <= 3.; theta += 1e-4)
          if (const double hoop = std::cos(theta / 2.) *
                                  (K_I * std::pow(std::cos(theta / 2.), 2) -
                                   1.5 * K_II * std::sin(theta));
              hoop > best)
            {
              best = hoop;
              at   = theta;
            }
        worst_angle = std::max(worst_angle, std::abs(direction.angle - at));
        worst_intensity =
          std::max(worst_intensity, std::abs(direction.intensity - best));
      }
    check_below("direction of growth, angle", worst_angle, 1e-4);
    check_below("direction of growth, intensity", worst_intensity, 1e-8);
    check("a crack without load grows nowhere",
          GrowthDirection(0., 0.).intensity == 0.);
  }



  /** That of the largest energy release rate, against an integral equation for
   * dislocations along a short kink of a long crack (Gauss-Chebyshev, 150 and
   * 300 points, extrapolated), Amestoy, Bui and Dang Van's 75.6 degrees of mode
   * II, and what it is close to mode I, where all criteria agree. */
  void
  check_direction_of_release()
  {
    const auto degrees = [](const double K_I, const double K_II) {
      return angle_of_largest_release(K_I, K_II) * 180. / pi;
    };
    for (const auto &[K_I, angle] :
         {std::pair{0., 75.752}, {0.5, 65.775}, {1., 56.565}, {2., 42.030}})
      check_below("largest energy release rate, K_I = " + std::to_string(K_I) +
                    " K_II",
                  std::abs(degrees(K_I, 1.) + angle),
                  0.01);
    check_below("in mode II 75.6 degrees",
                std::abs(degrees(0., -1.) - 75.6),
                0.2);
    const double small = angle_of_largest_release(1., 1e-3);
    check_below("close to mode I -2 K_II / K_I",
                std::abs(small / -2e-3 - 1.),
                1e-4);
    check_below("and that of the hoop stress",
                std::abs(small / GrowthDirection(1., 1e-3).angle - 1.),
                1e-4);
    check("a lip that slides the other way turns the crack the other way",
          degrees(1., 0.4) == -degrees(1., -0.4));
    check("pressed lips have no K_I", degrees(-2., 1.) == degrees(0., 1.));
    check("mode I goes straight on, as a crack without load",
          degrees(1., 0.) == 0. && degrees(0., 0.) == 0.);
  }
} // namespace

void
crack_modes()
{
  for (const unsigned int degrees : {0, 17, 45})
    check_exact_stress(degrees);
  check_growth_direction();
  check_direction_of_release();
}
