// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_simulation_run_setup_h
#define crevasse_simulation_run_setup_h

#include <crevasse/model/linear_choice.h>
#include <crevasse/periodic/periodic_choice.h>
#include <crevasse/postprocess/crack_tip_analysis.h>
#include <crevasse/postprocess/load_factors.h>
#include <crevasse/postprocess/probe.h>
#include <crevasse/time/step_control.h>


namespace Crevasse
{
  /**
   * What a run on one mesh computes with. Building it finds what is wrong with
   * mesh, boundaries, formulas and step sizes, and makes all choices; it
   * computes nothing, and does not change afterwards.
   */
  template <int dim>
  struct RunSetup
  {
    /** Collective. @throw SceneError, or NumericalError if the steps are
     * unstable. */
    RunSetup(const Scene &scene, std::shared_ptr<const Mesh<dim>> mesh);

    RunSetup(const RunSetup &) = delete;
    RunSetup &
    operator=(const RunSetup &) = delete;

    /** One that can be used; null without viscosity. */
    std::unique_ptr<Integrator>
    make_integrator() const;

    /** @throw NumericalError if the steps are beyond the limit of the
     * integrator. */
    std::unique_ptr<StepControl>
    make_step_control() const;

    /** Those of the scene, and the secular flow. */
    std::vector<Effects::Effect>
    active_effects(const SecularSplit &split) const;

    const Scene                             scene;
    const Body<dim>                         body;
    const StressRecovery<dim>               recovery;
    const std::vector<ProbeEvaluator<dim>>  probes;
    StepList                                steps;      ///< of the first period
    const std::unique_ptr<const Integrator> integrator; ///< what it is like
    RelaxationTimes                         relaxation_times;
    double                                  largest_thermal_strain;
    double                                  largest_nodal_force;
    double                                  missed_load; ///< by the steps
    PeriodicChoice                          periodic_choice;
    SecularSplit                            secular_split;
    SolverChoice                            solvers;
    std::unique_ptr<const CrackTipAnalysis> crack_tip;    ///< or null
    std::optional<LoadFactors>              load_factors; ///< to compare by
  };
} // namespace Crevasse

#endif
