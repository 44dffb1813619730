// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_simulation_simulation_h
#define crevasse_simulation_simulation_h

#include <crevasse/base/log.h>
#include <crevasse/base/problems.h>
#include <crevasse/base/summary.h>
#include <crevasse/checkpoint/kept_run.h>
#include <crevasse/discretisation/stress_recovery.h>
#include <crevasse/harmonic_balance/fourier_problem.h>
#include <crevasse/model/body.h>
#include <crevasse/model/secular_problem.h>
#include <crevasse/model/solvers.h>
#include <crevasse/parameters/scene.h>
#include <crevasse/periodic/observed_periods.h>
#include <crevasse/periodic/periodic_choice.h>
#include <crevasse/periodic/run_state.h>
#include <crevasse/postprocess/crack_tip_analysis.h>
#include <crevasse/postprocess/probe.h>
#include <crevasse/time/integrator.h>
#include <crevasse/time/step_control.h>
#include <crevasse/time/step_list.h>

#include <deal.II/base/timer.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace Crevasse
{
  /** The stress is not periodic after the last period allowed: all results are
   * written, but they are not what was asked for. */
  struct NotPeriodicError : NumericalError
  {
    using NumericalError::NumericalError;
  };

  /**
   * Composes one run from its scene: the only place that knows all the parts,
   * and that owns them.
   */
  template <int dim>
  class Simulation
  {
  public:
    /** Builds the discretised body, and so finds what is wrong with mesh,
     * boundaries and step sizes; computes nothing. */
    Simulation(const Scene                     &scene,
               std::shared_ptr<const Mesh<dim>> mesh,
               Log                             &log);

    /** Prints effects, sizes and predicted memory. */
    void
    describe() const;

    /** Computes, and writes everything to @p directory, which must exist; what
     * is not known before the end of the run only if this is it.
     * @throw NumericalError; after all that was computed has been written if
     * the periodic state was not reached.
     * @param state The start, then the end.
     * @param others see what the tables see.
     * @param summary that more is added to, and which is written.
     * @param checkpoints that are written, or that it goes on from. */
    void
    run(const std::string             &directory,
        RunState                      &state,
        Leg                           &leg,
        const std::vector<Observer *> &others,
        Summary                        summary,
        Checkpoints                   &checkpoints);

    const Body<dim> &
    discretised_body() const;

  private:
    /** Those of the scene, and the secular flow. */
    std::vector<Effects::Effect>
    effects() const;

    /** Lines about what can be computed, but is hardly meant. */
    std::vector<std::string>
    warnings() const;

    /** The flow that is split off, or was measured as drift. */
    void
    summarise_secular_flow(Summary &summary) const;

    /** What is solved for it if the split is on; if that fails and nothing
     * else needs it, the split is off. */
    void
    find_secular_flow(Solvers<dim> &solvers);

    /** Makes the flow that belongs to the samples that of the run. */
    void
    take_flow(const FourierResult &direct);

    /** What is solved direct in time; nothing if the method does without, or
     * if it fails and another one takes over. */
    std::optional<FourierResult>
    solve_directly(Solvers<dim> &solvers);

    void
    search(Solvers<dim>                  &solvers,
           const FourierResult           *direct,
           const std::vector<Observer *> &observers,
           RunState                      &state,
           Leg                           &leg,
           Checkpoints                   &checkpoints);

    /** What a checkpoint has about the run so far.
     * @param state at the beginning of the leg. */
    void
    serialize(const RunState       &state,
              const Solvers<dim>   &solvers,
              const Evolution<dim> &evolution,
              StateArchive         &archive) const;

    /** How many fields of the size of a stress a checkpoint may have: stress at
     * the instants of a period, viscous strain and rates, and what Anderson's
     * method remembers. */
    unsigned int
    n_kept_stresses() const;

    /** After which more may be wanted, for a periodic state is; or 0. */
    unsigned int
    last_period_of_search() const;

    /** Marches, or whatever the method is, and tells the summary about it. */
    void
    compute_periods(Solvers<dim>                  &solvers,
                    const FourierResult           *direct,
                    const std::vector<Observer *> &others,
                    const std::string             &directory,
                    RunState                      &state,
                    Leg                           &leg,
                    Summary                       &summary,
                    Checkpoints                   &checkpoints);

    /** What the run has come to, and what it took. */
    void
    write(Summary           &summary,
          RunState          &state,
          const std::string &directory) const;

    /** What integrator and step control have to say. */
    void
    summarise_steps(Summary &summary) const;

    void
    summarise(Summary &summary, Solvers<dim> &solvers) const;

    /** A-priori bound of the periods that a march takes, where there is one. */
    void
    describe_decay() const;

    /** When the paper's own test would have ended a march. */
    void
    report_end_by_change(const PeriodicResult &result) const;

    /** @throw NumericalError if the stress is nothing but rounding. */
    void
    require_meaning() const;

    /** @throw NotPeriodicError if the lip bears another mean force than the
     * secular problem has. */
    void
    require_contact_forces(const Summary &summary) const;

    /** @throw NotPeriodicError if the lip has gone on to close over the last
     * period, which no periodic state does. */
    void
    require_lip_at_rest(const Summary &summary) const;

    /** @throw NumericalError if the periodic state was not reached, or if the
     * stress is nothing but rounding. */
    void
    conclude(const PeriodicResult &result, const bool can_resume) const;

    const Scene    scene;
    const MPI_Comm communicator;
    Log           &log;

    mutable dealii::TimerOutput            phases;
    const Body<dim>                        body;
    const StressRecovery<dim>              recovery;
    const std::vector<ProbeEvaluator<dim>> probes;
    StepList                               steps;      // adaptive ones change
    const std::unique_ptr<Integrator>      integrator; // none without viscosity
    std::unique_ptr<StepControl>           step_control;
    const RelaxationTimes                  relaxation_times;
    const double                           largest_thermal_strain;
    const double                           largest_nodal_force;
    const double                           missed_load; ///< by the steps
    PeriodicChoice                         periodic_choice;
    SecularSplit                           secular_split;
    const std::unique_ptr<const CrackTipAnalysis> crack_tip; ///< or null
    std::optional<SecularFlow>                    secular_flow;
    std::size_t                                   rate_evaluations = 0;
    double                                        stress_rounding  = 0.;
    dealii::Timer                                 timer; ///< of a leg
    std::vector<std::string>                      direct_warnings;
  };
} // namespace Crevasse

#endif
