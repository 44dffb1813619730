// ---------------------------------------------------------------------
//
// Copyright (C) 2026 by the Crevasse authors
//
// This file is part of Crevasse. It is free software; you can use it,
// redistribute it and/or modify it under the terms of the GNU Lesser
// General Public License as published by the Free Software Foundation;
// either version 2.1 of the License, or (at your option) any later version.
//
// ---------------------------------------------------------------------

#ifndef crevasse_time_integrator_h
#define crevasse_time_integrator_h

#include <crevasse/time/rate_equation.h>

#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace Crevasse
{
  /** A rule on [0,1]: Σ weight × f(node), the weights sum up to 1. */
  struct TimeQuadrature
  {
    std::vector<double> nodes;
    std::vector<double> weights; ///< empty if steps follow no such rule
  };

  /** How often an integrator has done what, by name. */
  using IntegratorStatistics = std::vector<std::pair<std::string, std::size_t>>;

  /** Advances the ODE ṙ = f(r,t) step by step. */
  class Integrator
  {
  public:
    virtual ~Integrator() = default;

    /** Forgets what the last step knows about the beginning of the next:
     * r was changed, or the time. */
    virtual void
    restart();

    /**
     * One step from (t, r) to t + Δt.
     *
     * @param at_start called when the last evaluation of f was that at (t, r),
     * so that what f has solved on its way (the state at t) can be observed.
     */
    virtual void
    step(RateEquation                &f,
         const double                 t,
         const double                 time_step,
         Vector                      &r,
         const std::function<void()> &at_start) = 0;

    /** Largest Δt / τ_min for which decaying solutions decay; infinite for
     * implicit methods. */
    virtual double
    stability_limit() const = 0;

    /** The instants of a step at which f is evaluated, as fractions of the
     * step, and the rule by which it integrates an f that does not depend on
     * r. */
    virtual TimeQuadrature
    quadrature() const = 0;

    virtual std::string
    description() const = 0;

    /** Empty if there is nothing that the number of steps does not tell. */
    virtual IntegratorStatistics
    statistics() const;
  };
} // namespace Crevasse

#endif
