// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_periodic_observed_periods_h
#define crevasse_periodic_observed_periods_h

#include <crevasse/base/checkpointer.h>
#include <crevasse/base/meters.h>
#include <crevasse/periodic/return_defect.h>
#include <crevasse/periodic/stress_history.h>
#include <crevasse/time/observer.h>
#include <crevasse/time/step_control.h>

#include <deal.II/base/timer.h>

namespace Crevasse
{
  template <int dim>
  class Evolution;

  /** What a search for the periodic state has come to. */
  struct PeriodicResult
  {
    unsigned int periods   = 0;
    bool         converged = false; ///< within the tolerance, or elastic
    /** Whether the last two periods had (most of) their samples in common. */
    bool steps_repeat = true;
    /** What the strain lacked to return in the last period, see ReturnDefect,
     * where that counts; else 0. */
    double return_defect = 0.;

    // One entry a period, see PeriodReport.
    std::vector<double> stress_change;
    std::vector<double> stress_error_estimate;
  };

  /** When a search for the periodic state ends. */
  struct SearchLimits
  {
    unsigned int maximum_periods;
    double       tolerance; ///< for the estimated error of the stress; 0: none
  };

  /** What integrates a body over the steps of a period. */
  template <int dim>
  struct PeriodIntegration
  {
    Evolution<dim> &evolution;
    /** Null for a body without viscosity, whose periods are sequences of
     * elastic states. */
    Integrator   *integrator;
    StepControl  &step_control;
    StepList     &steps;
    Checkpointer *checkpointer; ///< called between steps
  };

  /**
   * The periods that a method computes, one after the other: each maps
   * r(0) to r(T) (the paper's Remark 2), is seen by the observers at the
   * beginning of every step, measured against the one before, and reported once
   * the method has judged it.
   */
  template <int dim>
  class ObservedPeriods
  {
  public:
    /** All arguments but the numbers must outlive this object, and so must what
     * @p integration refers to.
     *
     * @param before what was computed, and shown, already.
     * @param is_comparable whether the stress of the first period is compared
     * with none at all; that of another mesh it cannot be compared with.
     * @param defect null: the strain is not known to return. */
    ObservedPeriods(const PeriodIntegration<dim>  &integration,
                    const std::vector<Observer *> &observers,
                    const SearchLimits            &limits,
                    const PeriodicResult          &before = PeriodicResult(),
                    const bool                     is_comparable = true,
                    const ReturnDefect<dim>       *defect        = nullptr);

    /** Begins another period, unless the search has converged or as many are
     * computed as allowed. Between two periods, and at the end of the last one,
     * a run can be saved and resumed.
     *
     * @param r at the beginning of the period; where a run is resumed, at its
     * step. Unless steps are adaptive, a run resumed from the end of a search
     * computes the last period once more: its stresses need not be kept.
     * @return whether there is a period to compute(). */
    bool
    begins_another(Vector &r);

    /** Whether the body remembers: without viscosity one period tells all. */
    bool
    has_memory() const
    {
      return integration.integrator != nullptr;
    }

    /** Advances @p r over the period that was begun, or over the rest of it.
     * Returns the change of stress, see PeriodReport; nan if the steps are not
     * those of the period before. */
    double
    compute(Vector &r);

    /** Of the strain over the last period, relative to its largest stress; 0 if
     * it is not known to return. */
    double
    return_defect() const
    {
      return so_far.return_defect;
    }

    /** From now on it need not return where the lip opens, see ReturnDefect. */
    void
    ignore_drift_while_opening()
    {
      ignores_drift = true;
    }

    /** Whether it is known to return. */
    bool
    strain_returns() const
    {
      return defect != nullptr;
    }

    /** Ends the period that was computed.
     *
     * @param error_estimate of its stress; nan: it cannot be told. */
    void
    report(const double error_estimate);

    /** Solves for the state at the end of the last period, which otherwise only
     * the next period would, and shows it if @p is_shown. */
    void
    finish(const Vector &r, const bool is_shown = true);

    Checkpointer *
    checkpointer() const
    {
      return integration.checkpointer;
    }

    const PeriodicResult &
    result() const
    {
      return so_far;
    }

  private:
    const PeriodIntegration<dim>   integration;
    const std::vector<Observer *> &observers;
    const SearchLimits             limits;
    bool                           is_comparable;
    const ReturnDefect<dim>       *defect;

    /** Whether the search needs no further period, or may have none. */
    bool
    is_over() const
    {
      return so_far.converged || so_far.periods >= limits.maximum_periods;
    }

    /** All steps of a period from first_step on. */
    void
    advance(Vector &r);

    /** From the beginning of step @p k to the next one.
     *
     * @param is_shown to the observers. */
    void
    advance_step(const unsigned int k, Vector &r, const bool is_shown = true);

    /** Solves for the state at instant @p k as it is before a jump there. */
    void
    end_before_jump(const unsigned int k, const Vector &r, const bool is_shown);

    /** Computes the last period of a resumed run again, for its stresses. */
    void
    replay();

    /** What observers see where step @p k begins, or at the very end. */
    Sample
    sample(const unsigned int k, const Vector &r) const;

    void
    show(const Sample &sample) const
    {
      const Stopwatch watch("tables");
      for (Observer *observer : observers)
        observer->observe(sample);
    }

    void
    serialize(StateArchive &archive);

    /** Where step @p k begins. */
    void
    serialize_step(StateArchive &archive, unsigned int &k, Vector &r);

    StressHistory  history;
    unsigned int   first_step = 0; ///< of the period, or of what is left of it
    PeriodicResult so_far;
    PeriodReport   last; ///< not reported yet
    Vector         rate; ///< at the beginning of a step

    /** Where the last period began, if a checkpoint has this instead of the
     * stresses of all its steps. */
    Vector replay_from;

    Vector r_before, u_before; ///< at the beginning of the period
    bool   ignores_drift = false;
    bool   lip_opens     = false; ///< and stands open

    // Of the period that is being computed, and before it was resumed.
    dealii::Timer            timer;
    std::size_t              solves_before  = 0;
    double                   seconds_before = 0.;
    const SerializationScope part;
  };
} // namespace Crevasse

#endif
