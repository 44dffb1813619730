// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_time_integrator_h
#define crevasse_time_integrator_h

#include <crevasse/time/rate_equation.h>

#include <string>
#include <utility>
#include <vector>

namespace Crevasse
{
  class StateArchive;

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
     * Makes the last evaluation of f that at (t, r), so that what f has solved
     * on its way (the state at t) can be observed. Methods whose steps end with
     * that evaluation have nothing to do where one step follows the other.
     *
     * @param[out] rate f(r,t) for those methods that begin their steps with it;
     * it has the layout of r.
     */
    virtual void
    start(RateEquation &f, const double t, const Vector &r, Vector &rate);

    /**
     * One step from (t, r), which was the last start, to t + Δt. Several steps
     * of different lengths may be tried from one start.
     *
     * @param rate what start() gave.
     * @param[in,out] error null, or a vector to which the estimated error of
     * the step is added, if the method has_error_estimate(). It is the
     * difference to an embedded method of order 1, in which the step is not
     * continued.
     */
    virtual void
    advance(RateEquation &f,
            const double  t,
            const double  time_step,
            const Vector &rate,
            Vector       &r,
            Vector       *error = nullptr) = 0;

    virtual bool
    has_error_estimate() const
    {
      return false;
    }

    /** Largest Δt / τ_min for which decaying solutions decay; infinite for
     * methods without such a limit. */
    virtual double
    stability_limit() const = 0;

    /** Whether its state between two steps of a period can be shown; at the
     * beginning of a period it always can. */
    virtual bool
    may_pause() const
    {
      return true;
    }

    /** Shows what it knows between two steps; nothing if that is nothing. */
    virtual void
    serialize(StateArchive &);

    /** Whether every length of step has a matrix, and so a factorisation, of
     * its own. */
    virtual bool
    has_matrix_of_step() const
    {
      return false;
    }

    /** The instants of a step at which f is evaluated, as fractions of the
     * step, and the rule by which it integrates an f that does not depend on
     * r. */
    virtual TimeQuadrature
    quadrature() const = 0;

    virtual std::string
    description() const = 0;

    /** Empty if there is nothing that the number of steps does not tell. */
    virtual IntegratorStatistics
    statistics() const
    {
      return {};
    }
  };
} // namespace Crevasse

#endif
