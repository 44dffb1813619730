// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_time_adaptive_steps_h
#define crevasse_time_adaptive_steps_h

#include <crevasse/time/step_control.h>

#include <vector>

namespace Crevasse
{
  /**
   * Steps whose error of the stress is within a tolerance: a part of what an
   * embedded method of order 1 estimates.
   *
   * The first period finds them by a proportional–integral controller
   * (Gustafsson, ACM Trans. Math. Softw. 17, 1991; Hairer and Wanner, Solving
   * ODEs II, IV.2). Later periods use them again, as the paper proposes
   * (§6.2.1), so that samples, matrices and factorisations repeat: a step that
   * has become too long is divided for good. Where the state of the first
   * period has taken many more steps than a later one needs they are found
   * anew, at most three times.
   *
   * Where steps have matrices of their own, their lengths are those of the
   * intervals between the fixed instants divided by powers of 2, so that there
   * are few.
   */
  class AdaptiveSteps : public StepControl
  {
  public:
    struct Settings
    {
      double              relative_tolerance; ///< of the stress scale
      double              absolute_tolerance; ///< in units of stress
      double              largest_step;
      std::vector<double> fixed_instants; ///< where steps end in any case
      bool looks_at_end; ///< a stage of the method is at the end of the step
    };

    explicit AdaptiveSteps(const Settings &settings);

    void
    begin_period(StepList &steps) override;

    /** Takes what a step that has looked at its end has found there. */
    void
    start(Integrator        &integrator,
          RateEquation      &f,
          const StepList    &steps,
          const unsigned int k,
          const Vector      &r,
          Vector            &rate) override;

    /** @throw NumericalError if the tolerance takes too many steps. */
    void
    advance(Integrator        &integrator,
            RateEquation      &f,
            StepList          &steps,
            const unsigned int k,
            const Vector      &rate,
            Vector            &r) override;

    IntegratorStatistics
    statistics() const override;

    void
    serialize(StateArchive &archive) override;

  private:
    /** The length of the first trial from t on, at most up to the end. */
    double
    first_trial(const Integrator &integrator,
                const double      t,
                const double      end) const;

    /** The largest 2⁻ⁿ of the interval between fixed instants around t that
     * ends on a multiple of itself and is not longer than @p longest. */
    double
    dyadic_step(const double t, const double longest) const;

    /** The error of a trial relative to the tolerance. */
    double
    relative_error(const RateEquation &f, const Vector &r);

    /** The same, if no stage of a method has looked at the end of the step, of
     * the difference to the trapezoidal rule: a jump behind the last stage is
     * seen by that alone. */
    double
    relative_error_of_end(Integrator   &integrator,
                          RateEquation &f,
                          const double  t,
                          const double  step,
                          const Vector &rate,
                          const Vector &r);

    /** The controller's next step. */
    void
    propose(const double step, const double error, const bool was_rejected);

    const Settings settings;

    bool         is_free = true; ///< steps are being found
    unsigned int n_found = 0;    ///< how often they were
    double       proposed;
    double       last_error = 1.;

    // Of this period.
    double       needed = 0.; ///< the number of steps that would have done
    unsigned int taken  = 0;

    std::size_t accepted = 0, rejected = 0;

    Vector scale; ///< strain per stress
    Vector error, saved;

    // What is known of the end of the last step.
    double known_end = -1.; ///< negative: nothing
    Vector end_rate;
  };
} // namespace Crevasse

#endif
