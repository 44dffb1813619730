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

  /** A rule on [0,1]: Σ weight × f(node), the weights sum up to 1. */
  struct TimeQuadrature
  {
    std::vector<double> nodes;
    std::vector<double> weights; ///< empty if steps follow no such rule
  };

  /** How often an integrator has done what, by name. */
  using IntegratorStatistics = std::vector<std::pair<std::string, std::size_t>>;

  constexpr double no_stability_limit = std::numeric_limits<double>::infinity();

  /** What a method is like, whatever it integrates. */
  struct IntegratorProperties
  {
    std::string name; ///< for the log
    /** Largest Δt / τ_min for which decaying solutions decay. */
    double stability_limit = no_stability_limit;
    /** The instants of a step at which f is evaluated, as fractions of the
     * step, and the rule by which it integrates an f that does not depend on
     * r. */
    TimeQuadrature quadrature;
    /** Whether every length of step has a matrix, and so a factorisation, of
     * its own. */
    bool has_matrix_of_step = false;
    /** Whether its implicit stages follow an explicit one. */
    bool begins_explicitly = false;
    /** Whether it chooses its own steps by their error. The last one reaches
     * beyond the end of the step it was given, and is not shown: its state can
     * be kept at the beginning of a period alone. */
    bool controls_steps = false;
  };

  /** One step from (t, r), which was the last start, to t + length. Several of
   * different lengths may be tried from one start. */
  struct TimeStep
  {
    RateEquation &f;
    const double  t, length;
    const Vector &rate; ///< what Integrator::start() gave
    Vector       &r;
    /** Null, or a vector to which the estimated error of the step is added by
     * methods that have one: the difference to an embedded method of order 1,
     * in which the step is not continued. */
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

    /** Forgets what the last step knows about the beginning of the next:
     * r was changed, or the time. */
    virtual void
    restart()
    {
      is_continuing = false;
    }

    /**
     * Makes the last evaluation of f that at (t, r), so that what f has solved
     * on its way (the state at t) can be observed. Methods whose steps end with
     * that evaluation have nothing to do where one step follows the other.
     *
     * @param[out] rate f(r,t) for those methods that begin their steps with it;
     * it has the layout of r.
     */
    virtual void
    start(RateEquation &f, const double t, const Vector &r, Vector &rate)
    {
      f.rate(t, r, rate);
    }

    virtual void
    advance(const TimeStep &step) = 0;

    /** Shows what it knows between two steps; nothing if that is nothing. */
    virtual void
    serialize(StateArchive &)
    {
    }

    /** Empty if there is nothing that the number of steps does not tell. */
    virtual IntegratorStatistics
    statistics() const
    {
      return {};
    }

    const IntegratorProperties properties;

  protected:
    bool is_continuing = false; ///< the next step begins where the last ended
  };
} // namespace Crevasse

#endif
