// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_time_arkode_h
#define crevasse_time_arkode_h

#include <crevasse/parameters/parameters.h>
#include <crevasse/time/arkode_driver.h>
#include <crevasse/time/integrator.h>

#include <memory>

namespace Crevasse
{
  /**
   * The Runge–Kutta methods of ARKODE (SUNDIALS), explicit or diagonally
   * implicit, of order 2 to 5 (ArkodeTable). A step of the step list is one of
   * ARKODE's; or, with the step control "adaptive", ARKODE chooses its own from
   * an estimate of the error, and the steps of the list are intervals between
   * samples, which are interpolated.
   *
   * Tolerances are on the stress that an error of r makes where the strain is
   * held: constant for each point, for r itself may drift. ARKODE looks at the
   * root mean square over all points, but the error is largest where the stress
   * is, at the tip: tolerances are divided by how much larger the largest rate
   * of stress of the elastic body is than its root mean square.
   */
  class Arkode : public Integrator
  {
  public:
    Arkode(const TimeIntegrationParameters &parameters, const double period);

    void
    restart() override;

    void
    start(RateEquation &f,
          const double  t,
          const Vector &r,
          Vector       &rate) override;

    void
    advance(RateEquation &f,
            const double  t,
            const double  time_step,
            const Vector &rate,
            Vector       &r,
            Vector       *error) override;

    double
    stability_limit() const override;

    TimeQuadrature
    quadrature() const override;

    std::string
    description() const override;

    IntegratorStatistics
    statistics() const override;

    /** Not with its own steps, of which the last reaches beyond the sample and
     * which ARKODE keeps for itself. */
    bool
    may_pause() const override;

    void
    serialize(StateArchive &archive) override;

  private:
    /** Begins with ARKODE, or again from here. */
    void
    begin(const RateEquation &f,
          const double        t,
          const double        time_step,
          const Vector       &r);

    /** ARKODE itself, at t = 0. */
    void
    make_driver(const RateEquation &f, const double time_step, const Vector &r);

    /** The error of r that a step may make, see above. Solves for the elastic
     * body at some instants. */
    Vector
    tolerances(const RateEquation &f, const Vector &r);

    /** One step of that length from r on. */
    void
    take_fixed_step(const double t, const double time_step, Vector &r);

    /** Advances to @p end by ARKODE's own steps; r there. */
    void
    take_own_steps(const double end, const double time_step, Vector &r);

    /** The next instant behind @p t at which the scene has a step end. */
    double
    next_stop(const double t) const;

    /** An event was found on the step from @p last_t. What is interpolated
     * there has seen the other side of the kink: the step is repeated up to the
     * event, and that is where the next one begins. */
    void
    meet_event(const double last_t, const double time_step);

    /** Goes on behind it. Only when no more instants before it are asked for.
     */
    void
    leave_event();

    const TimeIntegrationParameters parameters;
    const double                    period;
    const bool                      is_implicit, is_adaptive;
    const ArkodeTable               table;

    RememberedRate                  equation;
    std::unique_ptr<EventFunctions> events; ///< if they are to be located
    std::unique_ptr<ArkodeDriver>   driver; ///< once there is an r
    Vector                          allowed_errors; ///< see tolerances()
    bool                            goes_on         = false;
    bool                            is_first_period = true;
    double                          usual_step = 0.; ///< not cut at the end
    double                          unit       = 0.; ///< of AlignedSteps
    unsigned int                    steps_of_period = 0;

    double       last_event         = 0.;
    double       pending_event      = -1.; ///< to go on behind; negative: none
    double       step_after_event   = 0.;
    unsigned int events_of_interval = 0;
    bool         gave_up        = false; ///< seeking events in this interval
    std::size_t  events_located = 0, events_given_up = 0;
    Vector       before_step; ///< r
  };
} // namespace Crevasse

#endif
