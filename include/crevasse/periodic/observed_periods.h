// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_periodic_observed_periods_h
#define crevasse_periodic_observed_periods_h

#include <crevasse/base/checkpointer.h>
#include <crevasse/base/meters.h>
#include <crevasse/periodic/converged_quantity.h>
#include <crevasse/periodic/net_slip.h>
#include <crevasse/periodic/return_defect.h>
#include <crevasse/periodic/stress_history.h>
#include <crevasse/time/integrator.h>
#include <crevasse/time/observer.h>
#include <crevasse/time/step_list.h>

#include <deal.II/base/timer.h>

namespace Crevasse
{
  template <int dim>
  class Evolution;

  /** Results of a search for the periodic state, so far. */
  struct PeriodicResult
  {
    unsigned int periods   = 0;
    bool         converged = false; ///< whether periodic, within tolerance
    /** Whether the last two periods had most of their instants in common. */
    bool steps_repeat = true;
    /** Missions that were computed, and whether none is left. */
    std::vector<unsigned int> missions;
    bool                      has_all_missions = false;
    /** ReturnDefect over the last period; 0 if it is ignored. */
    double return_defect = 0.;
    /** Estimated error of the last period that the tolerance is for: with
     * friction that of the net slip, if it is larger. */
    double judged_error = 0.;
    /** Where the stress changed most in the last period, for the log. */
    std::string place;

    // Changes and errors of the stress by period, see PeriodReport.
    std::vector<double> stress_change;
    std::vector<double> stress_error_estimate;
  };

  /** Conditions that end a search for the periodic state. */
  struct SearchLimits
  {
    unsigned int maximum_periods;
    double       tolerance; ///< limit of the error estimate; 0: none
    /** Quantity whose error is limited; null: the stress. */
    ConvergedQuantity *quantity = nullptr;
  };

  /**
   * Computes the periods of a search, one after the other. Each maps r(0) to
   * r(T) (the paper's Remark 2), is shown to the observers at the beginning of
   * every step, is compared with the period before, and is reported once the
   * search has estimated its error.
   */
  template <int dim>
  class ObservedPeriods
  {
  public:
    /** The arguments must outlive the ObservedPeriods.
     *
     * @param integrator null for a body without viscosity, whose periods are
     * sequences of elastic states.
     * @param checkpointer writes checkpoints between steps. */
    ObservedPeriods(Evolution<dim>                &evolution,
                    Integrator                    *integrator,
                    StepList                      &steps,
                    const std::vector<Observer *> &observers,
                    Checkpointer                  &checkpointer,
                    const SearchLimits            &limits);

    /** Continues after the periods that were computed and shown before.
     *
     * @param is_comparable whether the first period is compared with an
     * unstressed state; false on a new mesh. */
    void
    continue_from(const PeriodicResult &before, const bool is_comparable)
    {
      so_far              = before;
      this->is_comparable = is_comparable;
    }

    /** Requires that the viscous strain is periodic.
     *
     * @param return_defect must outlive the ObservedPeriods. */
    void
    require_return(const ReturnDefect<dim> &return_defect)
    {
      defect = &return_defect;
    }

    /** Requires, where the stress ends the search, that the net slip of periods
     * repeats, too.
     *
     * @param net_slip must outlive the ObservedPeriods. */
    void
    require_net_slip(const NetSlip<dim> &net_slip)
    {
      slip = &net_slip;
    }

    /** Begins another period, unless the search has converged or computed the
     * maximum of periods. Between periods, and at the end of the last one, the
     * run can be saved and resumed.
     *
     * @param r viscous strain at the beginning of the period; in a resumed run,
     * at its step. Unless steps are adaptive, a run resumed from the end of a
     * search computes the last period again, to save no stresses.
     * @return whether there is a period to compute(). */
    bool
    begins_another(Vector &r);

    /** Whether a period depends on the one before: the body is viscous, or its
     * lips bear friction. Otherwise a single period is enough. */
    bool
    remembers() const
    {
      return has_memory() || evolution.has_friction();
    }

    /** Whether the body is viscous. */
    bool
    has_memory() const
    {
      return integrator != nullptr;
    }

    /** Advances the viscous strain @p r to the end of the period. Returns the
     * change of stress, see PeriodReport; nan if the steps differ from those of
     * the period before.
     *
     * @param shows_end whether observers see the state at the end of a period
     * whose increments are summed, as before a jump. */
    double
    compute(Vector &r, const bool shows_end = false);

    /** What rounding in the solves leaves of the stress, relative to its
     * maximum: ten times their largest residual. As strain accumulates, the
     * forces that balance it grow beyond the loads, and so do residuals. */
    double
    rounding() const;

    /** ReturnDefect over the last period, relative to its largest stress; 0 if
     * the strain is not known to return. */
    double
    return_defect() const
    {
      return so_far.return_defect;
    }

    /** From now on a period is integrated as r − r(0), whose increments are
     * then accurate relative to themselves: see increment(). */
    void
    sum_increments()
    {
      sums_increments = true;
    }

    /** r(T) − r(0) of the last period, as the sum of its steps, if these are
     * summed. */
    const Vector &
    increment() const
    {
      return sum_of_steps;
    }

    /** Steps of the last period. */
    const StepList &
    time_steps() const
    {
      return steps;
    }

    /** Rule of the steps for the mean over a period. */
    const TimeQuadrature &
    quadrature() const
    {
      return integrator->properties.quadrature;
    }

    /** Stresses at the samples of the last period. */
    const StressHistory &
    stresses() const
    {
      return history;
    }

    /** Largest stress component of the last period. */
    double
    largest_stress() const
    {
      return last.largest_stress;
    }

    /** Ignores the ReturnDefect from now on while the whole lip opens. */
    void
    ignore_drift_while_opening()
    {
      ignores_drift = true;
    }

    /** Reports the computed period to the observers.
     *
     * @param error_estimate of the period's stress; nan: unknown.
     * @param mission number of the mission that the period is; 0: none. */
    void
    report(const double error_estimate, const unsigned int mission = 0);

    /** Lets no other period begin: all missions are computed. */
    void
    end_search()
    {
      so_far.has_all_missions = true;
    }

    /** Solves for the state at the end of the last period, which otherwise only
     * the next period would; shows it to the observers if @p is_shown. */
    void
    finish(const Vector &r, const bool is_shown = true);

    Checkpointer *
    checkpointer() const
    {
      return &writer;
    }

    const PeriodicResult &
    result() const
    {
      return so_far;
    }

  private:
    Evolution<dim>                &evolution;
    Integrator *const              integrator;
    StepList                      &steps;
    const std::vector<Observer *> &observers;
    Checkpointer                  &writer;
    const SearchLimits             limits;
    bool                           is_comparable = true;
    const ReturnDefect<dim>       *defect = nullptr; ///< null: may not return
    const NetSlip<dim>            *slip   = nullptr; ///< null: no friction

    /** Whether an estimated error of the stress ends the search. */
    bool
    is_within_tolerance(const double error_estimate) const
    {
      return !remembers() ||
             (limits.tolerance > 0. && error_estimate <= limits.tolerance);
    }

    /** Whether the search has converged, or used all its periods. */
    bool
    is_over() const
    {
      return so_far.has_all_missions || so_far.converged ||
             so_far.periods >= limits.maximum_periods;
    }

    /** Number of variational inequalities solved so far. */
    std::size_t
    n_solves() const;

    /** Change of stress in the period that has ended with @p r. */
    double
    end_period(const Vector &r);

    /** Advances @p r over the steps of a period from first_step on. */
    void
    advance(Vector &r);

    /** Advances @p r over step @p k.
     *
     * @param is_shown whether the observers see the beginning of the step. */
    void
    advance_step(const unsigned int k, Vector &r, const bool is_shown = true);

    /** Solves for the state at instant @p k as it is before a jump there. */
    void
    end_before_jump(const unsigned int k, const Vector &r, const bool is_shown);

    /** Computes the last period of a resumed run again, for its stresses. */
    void
    replay();

    /** Sample for observers at the beginning of step @p k, or at the end. */
    Sample
    sample(const unsigned int k, const Vector &r);

    void
    show(const Sample &sample) const
    {
      const Stopwatch watch("tables");
      for (Observer *observer : observers)
        observer->observe(sample);
    }

    void
    serialize(StateArchive &archive);

    /** Serialises the state at the beginning of step @p k. */
    void
    serialize_step(StateArchive &archive, unsigned int &k, Vector &r);

    StressHistory  history;
    unsigned int   first_step = 0; ///< first step to compute in the period
    PeriodicResult so_far;
    PeriodReport   last; ///< report on the last period, not yet sent
    Vector         rate; ///< ṙ at the beginning of a step

    /** Viscous strain at the beginning of the last period, which a checkpoint
     * may have instead of the stresses of all steps. */
    Vector replay_from;

    Vector r_before, u_before; ///< r and u at the beginning of the period
    Vector sum_of_steps, shown_strain; ///< increment(), r of a sample
    bool   sums_increments = false;
    bool   ignores_drift   = false;
    bool   lip_opens       = false; ///< whether the whole lip is open and opens

    // Effort of the current period, including that before it was resumed.
    dealii::Timer            timer;
    std::size_t              solves_before  = 0;
    double                   seconds_before = 0.;
    const SerializationScope part;
  };
} // namespace Crevasse

#endif
