// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/problems.h>
#include <crevasse/material/creep_point.h>

#include <algorithm>
#include <limits>

namespace Crevasse
{
  using namespace dealii;

  namespace
  {
    // The logarithm of numbers whose squares do not overflow.
    constexpr double largest_log = 300.;



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



    /** ln s, also of no stress. */
    template <int dim>
    double
    log_equivalent_stress(const VoigtVector<dim> &s)
    {
      return std::log(std::max(equivalent_stress<dim>(s),
                               std::numeric_limits<double>::min()));
    }
  } // namespace



  template <int dim>
  typename CreepPoint<dim>::Rate
  CreepPoint<dim>::rate(const VoigtVector<dim> &stress, const double k) const
  {
    const auto [log_secant, slope] =
      law->response(constants, log_equivalent_stress<dim>(stress));
    const double secant = std::exp(std::min(log_secant, largest_log));
    return {secant * direction<dim>(stress),
            k * slope * secant * modes.largest_rate()};
  }



  template <int dim>
  CreepLaw::DualPotential
  CreepPoint<dim>::dual_potential(const VoigtVector<dim> &stress) const
  {
    return law->dual_potential(constants, log_equivalent_stress<dim>(stress));
  }



  template <int dim>
  typename CreepPoint<dim>::Step
  CreepPoint<dim>::step(const double log_stress, const double log_kappa) const
  {
    const auto [log_secant, slope] = law->response(constants, log_stress);
    const double log_rho           = log_secant + log_kappa;
    return {std::exp(std::min(log_rho, largest_log)),
            std::max(log_rho - largest_log, 0.),
            slope};
  }



  template <int dim>
  VoigtVector<dim>
  CreepPoint<dim>::relaxed_stress(const VoigtVector<dim> &strain,
                                  const double            k,
                                  const double            log_kappa) const
  {
    constexpr unsigned int size  = n_stress_components<dim>;
    constexpr unsigned int most  = 100;
    constexpr double       small = 1e-8; // its square is rounding

    const VoigtVector<dim> &l       = modes.rates;
    const VoigtVector<dim>  elastic = k * (strain * modes.directions);
    double                  square  = 0.; // of s
    for (unsigned int i = 0; i < size; ++i)
      square += l[i] * elastic[i] * elastic[i];
    if (square == 0.)
      return modes.directions * elastic;
    // In x = ln s. Newton's steps stay between those of the least and the
    // largest slope, and so does the zero.
    double above = 0.5 * std::log(square), x = above;
    double below = -std::numeric_limits<double>::infinity(), steepest = 1.;
    for (unsigned int iteration = 0; iteration < most; ++iteration)
      {
        const Step now = step(x, log_kappa);
        steepest       = std::max(steepest, now.slope);
        VoigtVector<dim> y, growth; // dy/dx
        double           slope = 0.;
        square                 = 0.;
        for (unsigned int i = 0; i < size; ++i)
          {
            const double left = 1. / (1. + now.rho * l[i]);
            y[i]              = left * elastic[i];
            growth[i]         = (left - 1.) * (now.slope - 1.) * y[i];
            square += l[i] * y[i] * y[i];
            slope -= l[i] * y[i] * growth[i];
          }
        slope                   = 1. + slope / square;
        const double too_much   = x + now.left_out - 0.5 * std::log(square);
        const double correction = -too_much / slope;
        if (std::abs(correction) * now.slope < small)
          return modes.directions * (y + correction * growth);
        if (too_much > 0.)
          above = std::min(above, x - too_much / steepest);
        else
          below = std::max(below, x - too_much / steepest);
        x = std::max(below, std::min(above, x + correction));
      }
    throw NumericalError(
      "The stress that creep leaves after an implicit step was not found at a "
      "point. Take shorter steps, or look at [Material] Creep coefficient and "
      "its units.");
  }



  template <int dim>
  VoigtMatrix<dim>
  CreepPoint<dim>::relaxed_stiffness(const VoigtVector<dim> &stress,
                                     const double            log_kappa) const
  {
    const double     s    = equivalent_stress<dim>(stress);
    const Step       now  = step(log_equivalent_stress<dim>(stress), log_kappa);
    VoigtMatrix<dim> left = modes.directions; // X / D
    VoigtVector<dim> v;
    if (s > 0.)
      v = (direction<dim>(stress) * modes.directions) / s;
    for (unsigned int i = 0; i < n_stress_components<dim>; ++i)
      for (unsigned int j = 0; j < n_stress_components<dim>; ++j)
        left[i][j] /= 1. + now.rho * modes.rates[j];
    // Sherman and Morrison
    const VoigtVector<dim> w       = left * v;
    const double           beta    = now.rho * (now.slope - 1.);
    double                 product = 0.; // v·D⁻¹v
    for (unsigned int j = 0; j < n_stress_components<dim>; ++j)
      product += v[j] * v[j] / (1. + now.rho * modes.rates[j]);
    return left * transpose(modes.directions) -
           beta / (1. + beta * product) * outer_product(w, w);
  }



  template struct CreepPoint<2>;
  template struct CreepPoint<3>;
} // namespace Crevasse
