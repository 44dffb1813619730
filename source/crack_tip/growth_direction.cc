// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/crack_tip/growth_direction.h>

#include <deal.II/base/numbers.h>

#include <array>

namespace Crevasse
{
  using namespace dealii;

  namespace
  {
    constexpr double pi = numbers::PI, p2 = pi * pi, p4 = p2 * p2, p6 = p4 * p2;

    /** Coefficients of powers of m² in F₁₁, F₁₂/m, F₂₁/m, F₂₂ of a short kink
     * at the angle πm (Amestoy, Leblond, Int. J. Solids Struct. 29, 1992). */
    // clang-format off
    constexpr std::array<std::array<double, 11>, 4> kink = {{
      {{1., -3. * p2 / 8., p2 - 5. * p4 / 128.,
        p2 / 9. - 11. * p4 / 72. + 119. * p6 / 15360.,
        5.07790, -2.88312, -0.0925, 2.996, -4.059, 1.63, 4.1}},
      {{-3. * pi / 2., pi * (10. / 3. + p2 / 16.),
        pi * (-2. - 133. * p2 / 180. + 59. * p4 / 1280.),
        12.313906, -7.32433, 1.5793, 4.0216, -6.915, 4.21, 4.56, 0.}},
      {{pi / 2., -pi * (4. / 3. + p2 / 48.),
        pi * (-2. / 3. + 13. * p2 / 30. - 59. * p4 / 3840.),
        -6.176023, 4.44112, -1.5340, -2.0700, 4.684, -3.95, -1.32, 0.}},
      {{1., -4. - 3. * p2 / 8., 8. / 3. + 29. * p2 / 18. - 5. * p4 / 128.,
        -32. / 15. - 4. * p2 / 9. - 1159. * p4 / 7200. + 119. * p6 / 15360.,
        10.58254, -4.78511, -1.8804, 7.280, -7.591, 0.25, 12.5}}}};
    // clang-format on



    /** Slope ½ E' dG/dm of a kink's energy release at the angle πm. */
    double
    slope(const double m, const double K_I, const double K_II)
    {
      std::array<double, 4> F = {}, by_square = {}; // ∂F/∂m²
      for (unsigned int i = 0; i < 4; ++i)
        for (auto c = kink[i].rbegin(); c != kink[i].rend(); ++c)
          {
            by_square[i] = by_square[i] * m * m + F[i];
            F[i]         = F[i] * m * m + *c;
          }
      const auto even = [&](const unsigned int i) {
        return 2. * m * by_square[i];
      };
      const auto odd = [&](const unsigned int i) {
        return F[i] + 2. * m * m * by_square[i];
      };
      return std::max(F[0] * K_I + F[1] * m * K_II, 0.) *
               (even(0) * K_I + odd(1) * K_II) +
             (F[2] * m * K_I + F[3] * K_II) * (odd(2) * K_I + even(3) * K_II);
    }
  } // namespace



  double
  angle_of_largest_release(const double K_I, const double K_II)
  {
    if (K_II == 0.)
      return 0.;
    // On the side where K_II opens the kink, G has a single maximum up to 90°.
    const double side = K_II > 0. ? -1. : 1.;
    double       left = 0., right = 0.5;
    for (unsigned int i = 0; i < 60; ++i)
      {
        const double middle = 0.5 * (left + right);
        (side * slope(side * middle, std::max(K_I, 0.), K_II) > 0. ? left
                                                                   : right) =
          middle;
      }
    return side * pi * left;
  }
} // namespace Crevasse
