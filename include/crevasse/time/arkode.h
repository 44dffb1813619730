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
   * samples, which are interpolated. With events located, ARKODE's root finding
   * stops where a node of the lip switches, and begins anew there.
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
    restart() override
    {
      is_continuing = false;
    }

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
    stability_limit() const override
    {
      return table.stability_limit();
    }

    TimeQuadrature
    quadrature() const override;

    std::string
    description() const override;

    IntegratorStatistics
    statistics() const override;

    /** Not with its own steps, of which the last reaches beyond the sample and
     * which ARKODE keeps for itself. */
    bool
    may_pause() const override
    {
      return !is_adaptive;
    }

    void
    serialize(StateArchive &archive) override;

  private:
    /** The error of r that a step may make, see above. Solves for the elastic
     * body at some instants. */
    Vector
    tolerances(const RateEquation &f, const Vector &r);

    ArkodeDriver::Settings
    settings(const RateEquation &f, const Vector &r);

    /** ARKODE's own steps, samples and events up to @p end. */
    void
    take_own_steps(const double end, const double time_step);

    /** The next instant behind @p t at which the scene has a step end. */
    double
    next_stop(const double t) const;

    const TimeIntegrationParameters parameters;
    const double                    period;
    const bool                      is_implicit, is_adaptive;
    const ArkodeTable               table;

    CachedRate                    equation;
    std::unique_ptr<ArkodeDriver> driver;         ///< once there is an r
    Vector                        allowed_errors; ///< see tolerances()
    bool                          is_continuing = false;
    std::size_t                   n_events      = 0;
  };
} // namespace Crevasse

#endif
