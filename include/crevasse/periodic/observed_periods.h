// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_periodic_observed_periods_h
#define crevasse_periodic_observed_periods_h

#include <crevasse/periodic/period_map.h>
#include <crevasse/periodic/return_defect.h>
#include <crevasse/periodic/stress_history.h>

#include <deal.II/base/timer.h>

#include <cstddef>
#include <functional>
#include <vector>

namespace Crevasse
{
  /** What a search for the periodic state has come to. */
  struct PeriodicResult
  {
    unsigned int periods   = 0;
    bool         converged = false;
    /** Whether the last two periods had (most of) their samples in common. */
    bool steps_repeat = true;
    /** What the strain lacked to return in the last period, see ReturnDefect,
     * where that counts; else 0. */
    double return_defect = 0.;

    // One entry a period, see PeriodReport.
    std::vector<double> stress_change;
    std::vector<double> stress_error_estimate;
  };

  /**
   * The periods that a method computes, one after the other: each is seen by
   * the observers, measured against the one before, and reported once the
   * method has judged it.
   */
  template <int dim>
  class ObservedPeriods
  {
  public:
    /** The number of variational inequalities solved so far. */
    using SolveCount = std::function<std::size_t()>;

    /** All arguments but the numbers must outlive this object.
     *
     * @param before what was computed, and shown, already.
     * @param is_comparable whether the stress of the first period is compared
     * with none at all; that of another mesh it cannot be compared with.
     * @param defect null: the strain is not known to return. */
    ObservedPeriods(PeriodMap<dim>                &period_map,
                    const SolveCount              &n_solves,
                    const std::vector<Observer *> &observers,
                    const unsigned int             maximum_periods,
                    const PeriodicResult          &before = PeriodicResult(),
                    const bool                     is_comparable = true,
                    const ReturnDefect<dim>       *defect        = nullptr);

    /** Whether another period is allowed. */
    bool
    may_go_on() const;

    /** Whether bodies without viscosity, of which one period tells all. */
    bool
    has_memory() const;

    /** Advances @p r over a period. Returns the change of stress, see
     * PeriodReport; nan if the steps are not those of the period before. */
    double
    compute(Vector &r);

    /** Of the strain over the last period, relative to its largest stress; 0 if
     * it is not known to return. */
    double
    return_defect() const;

    /** From now on it need not return where the lip opens, see ReturnDefect. */
    void
    ignore_drift_while_opening();

    /** Whether it is known to return. */
    bool
    strain_returns() const;

    /** Instead of compute(): another period is not allowed, but others may go
     * on from here. */
    void
    stop_before(Vector &r);

    /** Ends the period that was computed.
     *
     * @param error_estimate of its stress; nan: it cannot be told. */
    void
    report(const double error_estimate);

    /** Shows the state at the end of the last period. */
    void
    finish(const Vector &r);

    /** Whoever wants to pause; null: nobody. */
    Checkpointer *
    checkpointer() const;

    /** All but whether it converged. */
    const PeriodicResult &
    result() const;

  private:
    PeriodMap<dim>                &period_map;
    const SolveCount               n_solves;
    const std::vector<Observer *> &observers;
    const unsigned int             maximum_periods;
    bool                           is_comparable;
    const ReturnDefect<dim>       *defect;

    void
    begin_period(const Vector &r);

    void
    show(const Sample &sample);

    void
    serialize(StateArchive &archive);

    StressHistory  history;
    PeriodicResult so_far;
    PeriodReport   last; ///< not reported yet

    // About the return of the strain, if it is known to.
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
