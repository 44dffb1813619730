// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/problems.h>
#include <crevasse/material/creep_power.h>

#include <algorithm>
#include <limits>

namespace Crevasse
{
  using namespace dealii;

  namespace
  {
    /** Hs = 3/2 dev s, with engineering shears. */
    template <int dim>
    VoigtVector<dim>
    direction(const VoigtVector<dim> &s)
    {
      const double     mean = (s[0] + s[1] + s[2]) / 3.;
      VoigtVector<dim> strain;
      for (unsigned int i = 0; i < n_stress_components<dim>; ++i)
        strain[i] = i < 3 ? 1.5 * (s[i] - mean) : 3. * s[i];
      return strain;
    }
  } // namespace



  template <int dim>
  VoigtVector<dim>
  CreepPower<dim>::relaxed_stress(const VoigtVector<dim> &strain,
                                  const double            k,
                                  const double            kappa) const
  {
    constexpr unsigned int size      = n_stress_components<dim>;
    constexpr unsigned int most      = 100;
    constexpr double       precision = 1e-14;

    const VoigtVector<dim> &l       = modes.rates;
    const VoigtVector<dim>  elastic = k * (strain * modes.directions);
    double                  square  = 0.; // of s_eq
    for (unsigned int i = 0; i < size; ++i)
      square += l[i] * elastic[i] * elastic[i];
    if (square == 0.)
      return modes.directions * elastic;
    // In x = ln m. Newton's steps stay between those of the least and the
    // largest slope, and so does the zero.
    VoigtVector<dim> y;
    double           above = 0.5 * (exponent - 1.) * std::log(square);
    double below = -std::numeric_limits<double>::infinity(), x = above;
    for (unsigned int k = 0; k < most; ++k)
      {
        const double relaxation = kappa * coefficient * std::exp(x);
        double       slope      = 0.;
        square                  = 0.;
        for (unsigned int i = 0; i < size; ++i)
          {
            const double left = 1. / (1. + relaxation * l[i]);
            y[i]              = left * elastic[i];
            const double part = l[i] * y[i] * y[i];
            square += part;
            slope += part * (1. - left);
          }
        slope                 = 1. + (exponent - 1.) * slope / square;
        const double too_much = x - 0.5 * (exponent - 1.) * std::log(square);
        if (std::abs(too_much) <= precision * std::max(1., std::abs(x)))
          return modes.directions * y;
        if (too_much > 0.)
          above = std::min(above, x - too_much / exponent);
        else
          below = std::max(below, x - too_much / exponent);
        x = std::max(below, std::min(above, x - too_much / slope));
      }
    throw NumericalError(
      "The stress that a power law leaves after an implicit step was not found "
      "at a point. Take shorter steps, or look at [Material] Creep "
      "coefficient and its units.");
  }



  template <int dim>
  VoigtMatrix<dim>
  CreepPower<dim>::relaxed_stiffness(const VoigtVector<dim> &stress,
                                     const double            kappa) const
  {
    const double     relaxation = kappa * coefficient * factor(stress);
    const double     s_eq       = equivalent_stress<dim>(stress);
    VoigtMatrix<dim> left       = modes.directions; // X / D
    VoigtVector<dim> v;
    if (s_eq > 0.)
      v = (direction<dim>(stress) * modes.directions) / s_eq;
    for (unsigned int i = 0; i < n_stress_components<dim>; ++i)
      for (unsigned int j = 0; j < n_stress_components<dim>; ++j)
        left[i][j] /= 1. + relaxation * modes.rates[j];
    // Sherman and Morrison
    const VoigtVector<dim> w       = left * v;
    const double           beta    = relaxation * (exponent - 1.);
    double                 product = 0.; // v·D⁻¹v
    for (unsigned int j = 0; j < n_stress_components<dim>; ++j)
      product += v[j] * v[j] / (1. + relaxation * modes.rates[j]);
    return left * transpose(modes.directions) -
           beta / (1. + beta * product) * outer_product(w, w);
  }



  template struct CreepPower<2>;
  template struct CreepPower<3>;
} // namespace Crevasse
