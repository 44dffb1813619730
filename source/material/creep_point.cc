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
    // Logarithm of the largest numbers whose squares do not overflow.
    constexpr double largest_log = 300.;



    /** Direction Hs = 3/2 dev s, with engineering shears. */
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



    /** Logarithm ln s, finite for s = 0. */
    double
    log_of(const double s)
    {
      return std::log(std::max(s, std::numeric_limits<double>::min()));
    }



    /** Parts w and R of a state with hardening. */
    template <int dim>
    using Parts = std::pair<double, VoigtVector<dim>>;

    template <int dim>
    Parts<dim>
    parts_of(VoigtVector<dim> state)
    {
      const double w = (state[0] + state[1] + state[2]) / 3.;
      if (!(w > 0.))
        return {0., VoigtVector<dim>()};
      for (unsigned int i = 0; i < 3; ++i)
        state[i] -= w;
      return {w, state};
    }



    template <int dim>
    VoigtVector<dim>
    with_trace(VoigtVector<dim> R, const double w)
    {
      for (unsigned int i = 0; i < 3; ++i)
        R[i] += w;
      return R;
    }
  } // namespace



  template <int dim>
  VoigtVector<dim>
  CreepPoint<dim>::strain(const VoigtVector<dim> &state) const
  {
    return parts_of<dim>(strains(state)).second;
  }



  template <int dim>
  VoigtVector<dim>
  CreepPoint<dim>::strains(const VoigtVector<dim> &state) const
  {
    const double m    = constants.back();
    const auto [w, R] = parts_of<dim>(state);
    return w > 0. ? std::pow(w, -m / (1. + m)) * state : R;
  }



  template <int dim>
  VoigtVector<dim>
  CreepPoint<dim>::state(const VoigtVector<dim> &strains) const
  {
    auto [crept, r] = parts_of<dim>(strains);
    double square   = 0.;
    for (unsigned int i = 0; i < n_stress_components<dim>; ++i)
      square += (i < 3 ? 2. : 1.) / 3. * r[i] * r[i];
    crept = std::max(crept, std::sqrt(square));
    return std::pow(crept, constants.back()) * with_trace<dim>(r, crept);
  }



  template <int dim>
  typename CreepPoint<dim>::Rate
  CreepPoint<dim>::rate(const VoigtVector<dim> &stress,
                        const VoigtVector<dim> &state,
                        const double            k,
                        const double            kappa) const
  {
    const double s                 = equivalent_stress<dim>(stress);
    const auto [log_secant, slope] = law->response(constants, log_of(s));
    const double           secant = std::exp(std::min(log_secant, largest_log));
    const double           softness = k * slope * modes.largest_rate();
    const VoigtVector<dim> creep    = secant * direction<dim>(stress); // fN
    if (!law->hardens || s == 0.)
      return {creep, softness * secant};

    constexpr double stable = 2.; // about the largest stable rate × step
    const double     m = constants.back(), f = secant * s;
    auto [w, R]     = parts_of<dim>(state);
    double hardness = (1. + m) * std::pow(softness / (stable * s), m);
    if (w > 0.)
      hardness = std::min(hardness, std::pow(w, -m / (1. + m)));
    // At the end of an implicit step, R/w = (R̂ + aN)/(ŵ + a).
    R += kappa / k * creep;
    w += kappa / k * f;
    return {with_trace<dim>(w > 0. ? creep + m * f / w * R : (1. + m) * creep,
                            (1. + m) * f),
            softness * secant * hardness};
  }



  template <int dim>
  VoigtMatrix<dim>
  CreepPoint<dim>::fluidity(const VoigtVector<dim> &stress) const
  {
    const double           s = equivalent_stress<dim>(stress);
    const VoigtVector<dim> N = (s > 0. ? 1. / s : 0.) * direction<dim>(stress);
    const auto [log_secant, slope] = law->response(constants, log_of(s));
    const double     secant = std::exp(std::min(log_secant, largest_log));
    VoigtMatrix<dim> result;
    for (unsigned int j = 0; j < n_stress_components<dim>; ++j)
      {
        VoigtVector<dim> unit;
        unit[j]                       = 1.;
        const VoigtVector<dim> column = direction<dim>(unit);
        for (unsigned int i = 0; i < n_stress_components<dim>; ++i)
          result[i][j] = secant * (column[i] + (slope - 1.) * N[i] * N[j]);
      }
    return result;
  }



  template <int dim>
  CreepLaw::DualPotential
  CreepPoint<dim>::dual_potential(const VoigtVector<dim> &stress) const
  {
    return law->dual_potential(constants,
                               log_of(equivalent_stress<dim>(stress)));
  }



  template <int dim>
  DEAL_II_ALWAYS_INLINE inline typename CreepPoint<dim>::Step
  CreepPoint<dim>::step(const double log_stress,
                        const double known,
                        const double k,
                        const double log_kappa) const
  {
    const auto [log_secant, slope] = law->response(constants, log_stress);
    const double log_rho           = log_secant + log_kappa;
    const double rho               = std::exp(std::min(log_rho, largest_log));
    const double left_out          = std::max(log_rho - largest_log, 0.);
    if (!law->hardens)
      return {rho, left_out, slope, slope - 1., 1., 0.};
    constexpr double least  = std::numeric_limits<double>::min();
    const double     m      = constants.back();
    const double     a      = rho / k * std::exp(log_stress);
    const double     w      = std::max(known + (1. + m) * a, least);
    const double     sum    = std::max(known + a, least);
    const double     beta   = std::pow(w, 1. / (1. + m)) / sum;
    const double     growth = slope * a * (1. / w - 1. / sum);
    return {beta * rho,
            left_out / (1. + m),
            slope * sum / w,
            slope - 1. + growth,
            beta,
            beta * growth};
  }



  template <int dim>
  VoigtVector<dim>
  CreepPoint<dim>::relaxed_stress(const VoigtVector<dim> &strain,
                                  const VoigtVector<dim> &known,
                                  const double            k,
                                  const double            log_kappa) const
  {
    constexpr unsigned int size  = n_stress_components<dim>;
    constexpr unsigned int most  = 100;
    constexpr double       small = 1e-8; // its square is rounding

    const VoigtVector<dim> &l       = modes.rates;
    const bool              hardens = law->hardens;
    const VoigtVector<dim>  of_strain =
      k * ((hardens ? strain : strain - known) * modes.directions);
    VoigtVector<dim> elastic = of_strain, of_known;
    double           w       = 0.;
    if (hardens)
      {
        VoigtVector<dim> R;
        std::tie(w, R) = parts_of<dim>(known);
        of_known       = k * (R * modes.directions);
        const double m = constants.back();
        if (w > 0.)
          elastic -= std::pow(w, -m / (1. + m)) * of_known;
      }
    double square = 0.; // s²
    for (unsigned int i = 0; i < size; ++i)
      square += l[i] * elastic[i] * elastic[i];
    if (square == 0.)
      return modes.directions * elastic;
    // Newton's method for x = ln s. Without hardening, steps with the least and
    // the largest slope enclose the zero.
    constexpr double infinity = std::numeric_limits<double>::infinity();
    double           x        = 0.5 * std::log(square);
    double           above = hardens ? infinity : x, below = -infinity;
    double           steepest  = hardens ? infinity : 1.;
    double           last_step = infinity;
    for (unsigned int iteration = 0; iteration < most; ++iteration)
      {
        const Step now     = step(x, w, k, log_kappa);
        steepest           = std::max(steepest, now.radial_slope);
        VoigtVector<dim> y = of_strain, left;
        if (hardens)
          y -= now.beta * of_known;
        double slope = 0.;
        square       = 0.;
        for (unsigned int i = 0; i < size; ++i)
          {
            left[i] = 1. / (1. + now.rho * l[i]);
            y[i] *= left[i];
            const double part = l[i] * y[i] * y[i];
            square += part;
            slope += part * (1. - left[i]) * now.growth_of_rho;
            if (hardens)
              slope += l[i] * y[i] * left[i] * now.growth_of_beta * of_known[i];
          }
        slope                   = 1. + slope / square;
        const double too_much   = x + now.left_out - 0.5 * std::log(square);
        const double correction = -too_much / slope;
        if (std::abs(correction) * (1. + std::abs(now.growth_of_rho)) < small)
          {
            for (unsigned int i = 0; i < size; ++i) // dy/dx
              y[i] += correction * ((left[i] - 1.) * now.growth_of_rho * y[i] -
                                    left[i] * now.growth_of_beta * of_known[i]);
            return modes.directions * y;
          }
        if (too_much > 0.)
          above = std::min(above, x - too_much / steepest);
        else
          below = std::max(below, x - too_much / steepest);
        const double before = x;
        x                   = std::max(below, std::min(above, x + correction));
        if (hardens && (x == below || x == above))
          x = 0.5 * (std::max(below, x - 2.) + std::min(above, x + 2.));
        // Newton's method may alternate between two points.
        if (hardens && above - below < infinity &&
            std::abs(x - before) > 0.5 * last_step)
          x = 0.5 * (below + above);
        last_step = std::abs(x - before);
      }
    throw NumericalError(
      "The iteration for the stress of an implicit creep step did not converge "
      "at a point. Take shorter steps, or check [Material] Creep coefficient "
      "and its units.");
  }



  template <int dim>
  VoigtMatrix<dim>
  CreepPoint<dim>::relaxed_stiffness(const VoigtVector<dim> &stress,
                                     const VoigtVector<dim> &known,
                                     const double            k,
                                     const double            log_kappa) const
  {
    constexpr double softest = 1e-20; // relative to K, below rounding
    const double     s       = equivalent_stress<dim>(stress);
    const double     w       = law->hardens ? parts_of<dim>(known).first : 0.;
    const Step       now     = step(log_of(s), w, k, log_kappa);
    const double rho = std::min(now.rho, 1. / (softest * modes.largest_rate()));
    VoigtMatrix<dim> left = modes.directions; // X / D
    VoigtVector<dim> v;
    if (s > 0.)
      v = (direction<dim>(stress) * modes.directions) / s;
    for (unsigned int i = 0; i < n_stress_components<dim>; ++i)
      for (unsigned int j = 0; j < n_stress_components<dim>; ++j)
        left[i][j] /= 1. + rho * modes.rates[j];
    // Sherman and Morrison
    const VoigtVector<dim> radial  = left * v;
    const double           beta    = rho * (now.radial_slope - 1.);
    double                 product = 0.; // v·D⁻¹v
    for (unsigned int j = 0; j < n_stress_components<dim>; ++j)
      product += v[j] * v[j] / (1. + rho * modes.rates[j]);
    return left * transpose(modes.directions) -
           beta / (1. + beta * product) * outer_product(radial, radial);
  }



  template struct CreepPoint<2>;
  template struct CreepPoint<3>;
} // namespace Crevasse
