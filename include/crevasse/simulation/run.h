// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_simulation_run_h
#define crevasse_simulation_run_h

#include <crevasse/checkpoint/checkpoints.h>
#include <crevasse/crack_tip/creep_integral.h>
#include <crevasse/harmonic_balance/fourier_problem.h>
#include <crevasse/model/contact_system_cache.h>
#include <crevasse/model/largest_load.h>
#include <crevasse/parameters/automatic.h>
#include <crevasse/periodic/periodic_choice.h>
#include <crevasse/periodic/run_state.h>
#include <crevasse/postprocess/crack_front_analysis.h>
#include <crevasse/postprocess/crack_tip_analysis.h>
#include <crevasse/postprocess/lip_closure.h>
#include <crevasse/postprocess/load_factors.h>
#include <crevasse/postprocess/probe.h>
#include <crevasse/simulation/period_estimate.h>
#include <crevasse/time/evolution.h>
#include <crevasse/time/integrator_choice.h>

namespace Crevasse
{
  /** What loads and material of a run reach within a period. */
  struct Magnitudes
  {
    RelaxationTimes relaxation_times;
    double          largest_thermal_strain;
    double          largest_nodal_force;
    double          missed_load; ///< largest load that steps miss, relative
  };

  /**
   * A run on one mesh: owns the body and all that computes its periods. The
   * constructor checks mesh, boundaries, formulas and step sizes, and makes all
   * choices; it computes no states. Then prepare(), search() and conclude()
   * follow. Members are public for those who report on a run and receive it as
   * constant.
   */
  template <int dim>
  class Run
  {
  public:
    /** Checks and chooses. References must outlive the Run. Collective.
     *
     * @param state of the run before this mesh, and then after it.
     * @throw SceneError, or NumericalError if steps are unstable. */
    Run(const Scene                      &scene,
        const std::shared_ptr<Mesh<dim>> &mesh,
        Log                              &log,
        Checkpoints                      &checkpoints,
        RunState                         &state);

    // Members refer to each other, so the object cannot be copied.
    Run(const Run &) = delete;

    /** Finds the flow or the whole periodic state if that needs no periods,
     * writes the relaxation table, and creates the observers. Collective.
     * @throw NumericalError if the run needs a solution that is not found. */
    void
    prepare();

    /**
     * Computes periods until the stress is periodic, the maximum of periods is
     * reached, or the mesh is to change. A motion found by harmonic balance is
     * verified and shown; otherwise periods are marched or accelerated. The
     * state has the result and the strain after the last period, and the
     * displacement unless the run ends. Collective.
     *
     * @return whether the run ends.
     * @throw NumericalError if a step fails, or if the motion found is not a
     * solution and no other method may replace it.
     */
    bool
    search();

    /** Writes the final results and the summary, then checks that they are as
     * requested. Collective.
     *
     * @param summary of the meshes, to add to.
     * @throw FileError; NumericalError if the stress is only rounding, if the
     * periodic state was not reached, if the mean force on the lip differs from
     * the secular problem, or if the lip closes further in the last period. */
    void
    conclude(Summary summary);

    /** Effects of the scene, and the secular flow. */
    std::vector<Effects::Effect>
    active_effects() const;

    const Scene &scene;
    Log         &log;
    Checkpoints &checkpoints;
    RunState    &state;

  private:
    const std::shared_ptr<Mesh<dim>> mesh;

    /** The body. Its lip's negligible force is set with the magnitudes, which
     * first find formulas without a value. */
    Body<dim> own_body;

  public:
    const Body<dim>                       &body = own_body;
    const StressRecovery<dim>              recovery;
    const std::vector<ProbeEvaluator<dim>> probes;
    StepList                               steps; ///< adaptive steps change
    std::unique_ptr<Integrator> integrator;       ///< null without viscosity
    const Magnitudes            magnitudes;

    const SolverChoice       solvers;
    PeriodicChoice           choice; ///< choice, or its replacement
    SecularSplit             split;
    std::vector<std::string> later_warnings; ///< of prepare()

    ContactSystemCache<dim> systems;
    Evolution<dim>          evolution;

    Effects::Effect                                      stress_intensity;
    std::vector<std::unique_ptr<const CrackTipAnalysis>> crack_tips;
    std::vector<Summary> tips_without_intensity; ///< tips, and why ("no_K")
    /** For each tip, or one for all fronts. */
    std::vector<std::unique_ptr<const CreepIntegral<dim>>> creep_integrals;
    std::unique_ptr<const CrackFrontAnalysis>
                               crack_front;  ///< in space; null in a plane
    std::optional<LoadFactors> load_factors; ///< for the elastic comparison

    std::optional<SecularFlow>   flow;   ///< none: not sought or not found
    std::optional<FourierResult> direct; ///< harmonic balance

    std::unique_ptr<PeriodEstimate<dim>>   estimate; ///< null: mesh stays
    std::vector<std::unique_ptr<Observer>> observers;
    ConvergedQuantity *quantity = nullptr; ///< an observer; null: the stress
    LipClosure<dim>   *closure  = nullptr; ///< an observer; null: no contact
    NetSlip<dim>      *net_slip = nullptr; ///< an observer; null: no friction

  private:
    /** Finds what describes the crack's tips or front. */
    void
    find_tips();

    /** Finds tips with K; "automatic" switches K off if no tip has a K. */
    void
    find_tips_with_intensity();

    /** @throw SceneError if the body has no Converged quantity. */
    void
    check_quantity() const;

    // Parts of prepare().
    void
    balance_harmonics();
    /** Sets the flow of the samples as the flow of the run. */
    void
    take_flow_of_samples();
    /** Finds the flow; if it fails, continues without it, or throws. */
    void
    find_secular_flow();
    /** Logs the paper's Table 1 and writes it to relaxation.csv. */
    void
    write_relaxation_table();
    /** Creates the observers that write or print what the scene asks for. */
    void
    make_observers();

    // Parts of search().
    void
    prepare_evolution();
    /** Shows the period found, and compares it with its states: not converged
     * if they differ and another method may replace it. */
    PeriodicResult
    show_motion(std::vector<Observer *> all, Checkpointer &writer);
    void
    accelerate(ObservedPeriods<dim> &periods, const double slowness);
    /** Marches or accelerates until the stress is periodic or the periods of
     * this mesh are over.
     *
     * @param before results of the periods that were shown before.
     * @param last_period last one on this mesh.
     * @return whether the run ends. */
    bool
    find_periodic_state(const std::vector<Observer *> &all,
                        Checkpointer                  &writer,
                        const PeriodicResult          &before,
                        const unsigned int             last_period);
    /** Finds the periodic state or the missions by the averaged body. */
    void
    use_average(ObservedPeriods<dim> &periods, const UnilateralBounds &bounds);
  };
} // namespace Crevasse

#endif
