// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_time_integrator_h
#define crevasse_time_integrator_h

#include <crevasse/time/rate_equation.h>

#include <limits>
#include <string>
#include <utility>

namespace Crevasse
{
  class StateArchive;

  /** Quadrature rule on [0,1]: Σ weight × f(node); weights add up to 1. */
  struct TimeQuadrature
  {
    std::vector<double> nodes;
    std::vector<double> weights; ///< empty: no such rule
  };

  /** Counters of an integrator, by name. */
  using IntegratorStatistics = std::vector<std::pair<std::string, std::size_t>>;

  constexpr double no_stability_limit = std::numeric_limits<double>::infinity();

  /** Properties of a method, for any equation. */
  struct IntegratorProperties
  {
    std::string name; ///< name for the log
    /** Largest Δt / τ_min for which decaying solutions decay. */
    double stability_limit = no_stability_limit;
    /** Instants of a step at which f is evaluated, as fractions of the step,
     * and the method's quadrature rule for an f that does not depend on r. */
    TimeQuadrature quadrature;
    /** Whether every length of step has its own matrix and factorisation. */
    bool has_matrix_of_step = false;
    /** Whether an explicit stage precedes the implicit stages. */
    bool begins_explicitly = false;
    /** Whether the method chooses its own steps by their error. Its last step
     * exceeds the end of the given step, and is not shown: its state can be
     * saved only at the beginning of a period. */
    bool controls_steps = false;
    /** Whether a period that is computed again has the same steps. */
    bool repeats_steps = true;
  };

  /** Step from (t, r), given to Integrator::start(), to t + length. Several
   * lengths may be tried from one start. */
  struct TimeStep
  {
    RateEquation &f;
    const double  t, length;
    const Vector &rate; ///< result of Integrator::start()
    Vector       &r;
    /** Null, or a vector to which methods with an embedded method of order 1
     * add the estimated error of the step: their difference. The step is
     * continued in the method itself, not in the embedded one. */
    Vector *error = nullptr;
  };

  /** Advances the ODE ṙ = f(r,t) step by step. */
  class Integrator
  {
  public:
    explicit Integrator(const IntegratorProperties &properties)
      : properties(properties)
    {
    }

    virtual ~Integrator() = default;

    /** Forgets data of the last step for the next, because r or the time was
     * changed. */
    virtual void
    restart()
    {
      is_continuing = false;
    }

    /** Restarts at the beginning of a period. */
    virtual void
    begin_period()
    {
      restart();
    }

    /**
     * Evaluates f at (t, r) as the last evaluation, so that the state at t,
     * which f has solved for, can be observed. Methods whose steps end with
     * this evaluation do nothing between consecutive steps.
     *
     * @param[out] rate f(r,t) for methods that begin their steps with it, in
     * the layout of r.
     */
    virtual void
    start(RateEquation &f, const double t, const Vector &r, Vector &rate)
    {
      f.rate(t, r, rate);
    }

    /** Advances r by the step, or by a part of it that the method chooses, see
     * StepControl. */
    virtual void
    advance(const TimeStep &step) = 0;

    /** Serialises the state kept between two steps, if any. */
    virtual void
    serialize(StateArchive &)
    {
    }

    /** Statistics; empty unless a method counts more than its steps. */
    virtual IntegratorStatistics
    statistics() const
    {
      return {};
    }

    const IntegratorProperties properties;

  protected:
    bool is_continuing = false; ///< next step continues the last
  };
} // namespace Crevasse

#endif
