// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_postprocess_outputs_h
#define crevasse_postprocess_outputs_h

#include <crevasse/base/log.h>
#include <crevasse/base/summary.h>
#include <crevasse/model/body.h>
#include <crevasse/model/solvers.h>
#include <crevasse/periodic/run_state.h>
#include <crevasse/postprocess/contact_onset.h>
#include <crevasse/postprocess/crack_tip_analysis.h>
#include <crevasse/postprocess/drift.h>
#include <crevasse/postprocess/elastic_comparison.h>
#include <crevasse/postprocess/field_writer.h>
#include <crevasse/postprocess/probe.h>
#include <crevasse/postprocess/progress.h>
#include <crevasse/postprocess/tables.h>
#include <crevasse/time/integrator.h>

#include <memory>
#include <string>
#include <vector>

namespace Crevasse
{
  /** All that a run writes or prints while it computes and at its end; what
   * the scene does not ask for is not there. */
  template <int dim>
  class Outputs
  {
  public:
    /** All arguments must outlive this object.
     * @param crack_tip what is to be read off there; null: nothing.
     * @param flow that the mean load causes; null: none, or it is not known.
     * @param periods_are_iterates Extremes are those of the last period then.
     * @param start after whose periods tables go on.
     */
    Outputs(const Scene                            &scene,
            const Body<dim>                        &body,
            const StressRecovery<dim>              &recovery,
            const std::vector<ProbeEvaluator<dim>> &probes,
            Solvers<dim>                           &solvers,
            const StepList                         &steps,
            const Integrator                       *integrator,
            const CrackTipAnalysis                 *crack_tip,
            const SecularFlow                      *flow,
            const bool                              periods_are_iterates,
            const RunState                         &start,
            Log                                    &log,
            const std::string                      &directory);

    const std::vector<Observer *> &
    observers() const
    {
      return all;
    }

    /** The names of the tables that go on from step to step. */
    const std::vector<std::string> &
    tables() const
    {
      return names_of_tables;
    }

    /** Writes the fields, prints what was found, and adds it to the summary:
     * extremes, drift, elastic_comparison. */
    void
    finish(Summary &summary);

    /** Tells the rest of the run what this part of it has seen. */
    void
    hand_over(RunState &state) const;

    /** What rounding leaves of the stress at most, relative to its maximum: it
     * is K times the small difference of strains that may be large. */
    double
    stress_rounding() const;

  private:
    /** Keeps the largest stress, displacement and viscous strain of the run. */
    struct Extremes;

    template <typename Derived, typename... Arguments>
    Derived *
    add(Arguments &&...arguments);

    /** summary.json "drift": what the displacement has gained over the last
     * period, divided by its length T (length/time): the largest component of
     * any node, the vector at each probe, and how fast the lip closes at a node
     * at most. This is measured, whether the stress is periodic yet or not; the
     * rate β of the secular problem is its limit, which closes no lip. */
    void
    finish_drift(Summary &summary) const;
    void
    finish_comparison(Summary &summary) const;
    void
    beware_of_large_displacements() const;

    /** summary.json "secular": when the lip is free of the flow's start. */
    void
    finish_onset(Summary &summary) const;

    const Body<dim>        &body;
    const StepList         &steps;
    const CrackTipAnalysis *crack_tip;
    const SecularFlow      *flow;
    Log                    &log;
    const std::string       directory;
    const double            opening_before; ///< the largest

    const std::vector<ProbeEvaluator<dim>> &probes;
    std::vector<std::unique_ptr<Observer>>  owned;
    std::vector<Observer *>                 all;
    std::vector<std::string>                names_of_tables;

    // Some of the above, where they are on.
    ContactTable<dim> *contact_table   = nullptr;
    ContactOnset<dim> *onset           = nullptr;
    Drift             *drift           = nullptr;
    ElasticComparison *comparison      = nullptr;
    CrackTipTable     *crack_tip_table = nullptr;
    FieldWriter<dim>  *fields          = nullptr;
    Extremes          *extremes        = nullptr;
  };
} // namespace Crevasse

#endif
