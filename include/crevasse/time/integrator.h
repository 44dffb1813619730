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

#include <deal.II/lac/la_parallel_vector.h>

#include <functional>
#include <string>
#include <vector>

namespace Crevasse
{
  using Vector = dealii::LinearAlgebra::distributed::Vector<double>;

  /** ṙ = f(r,t): writes f into the last argument. */
  using RateFunction =
    std::function<void(const double t, const Vector &r, Vector &rate)>;

  /** A rule on [0,1]: Σ weight × f(node), the weights sum up to 1. */
  struct TimeQuadrature
  {
    std::vector<double> nodes;
    std::vector<double> weights;
  };

  /** Advances the ODE ṙ = f(r,t) step by step. */
  class Integrator
  {
  public:
    virtual ~Integrator() = default;

    /**
     * One step from (t, r) to t + Δt; the first evaluation of f is at (t, r).
     *
     * @param at_start called right after that evaluation, when what f has
     * solved on its way (the state at t) can be observed.
     */
    virtual void
    step(const RateFunction          &f,
         const double                 t,
         const double                 time_step,
         Vector                      &r,
         const std::function<void()> &at_start) = 0;

    /** Largest Δt / τ_min for which decaying solutions decay. */
    virtual double
    stability_limit() const = 0;

    /** The rule by which a step integrates an f that does not depend on r. */
    virtual TimeQuadrature
    quadrature() const = 0;

    virtual std::string
    description() const = 0;
  };
} // namespace Crevasse

#endif
