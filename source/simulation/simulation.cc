// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/machine_memory.h>
#include <crevasse/base/problems.h>
#include <crevasse/linear/abandoned_factors.h>
#include <crevasse/model/jumps.h>
#include <crevasse/model/largest_load.h>
#include <crevasse/periodic/period_map.h>
#include <crevasse/periodic/periodic_search.h>
#include <crevasse/postprocess/elastic_reference.h>
#include <crevasse/postprocess/outputs.h>
#include <crevasse/postprocess/relaxation_table.h>
#include <crevasse/simulation/simulation.h>
#include <crevasse/time/integrator_choice.h>

#include <deal.II/base/utilities.h>

#include <algorithm>
#include <cstdio>

namespace Crevasse
{
  using namespace dealii;

  namespace
  {
    /** The instants at which a run evaluates formulas, and some between. */
    std::vector<double>
    survey_instants(const StepList &steps, const Integrator *integrator)
    {
      return steps.survey_instants(integrator != nullptr
                                     ? integrator->quadrature().nodes
                                     : std::vector<double>());
    }



    /** Finds what is wrong with loads and material before anything is computed
     * with them, and the extreme relaxation times. */
    template <int dim>
    RelaxationTimes
    survey(const Body<dim>           &body,
           const std::vector<double> &instants,
           const double               period)
    {
      body.loads.survey(instants, body.space.communicator());
      return body.material.survey(instants, period);
    }



    /** Jumps are marked in the steps: a choice depends on them. */
    template <int dim>
    PeriodicChoice
    choose_with_jumps(const Scene           &scene,
                      const Body<dim>       &body,
                      StepList              &steps,
                      const RelaxationTimes &times,
                      const double           largest_load)
    {
      steps.set_jumps(find_jumps(scene, body, steps, largest_load));
      return choose_periodic_method(scene, body, steps, times.largest);
    }



    /** The bounds that a displacement touches. */
    std::vector<bool>
    touching_bounds(const UnilateralBounds &bounds, const Vector &displacement)
    {
      const double      rounding = 1e-10 * displacement.linfty_norm();
      std::vector<bool> touches;
      for (unsigned int k = 0; k < bounds.dofs.size(); ++k)
        touches.push_back(bounds.sign[k] * displacement(bounds.dofs[k]) -
                            bounds.gap[k] <=
                          rounding);
      return touches;
    }



    /** Nothing unless the scene asks for it, which in space it cannot. */
    template <int dim>
    std::unique_ptr<const CrackTipAnalysis>
    make_crack_tip_analysis(const Scene        &scene,
                            const Body<dim>    &body,
                            const SecularSplit &split,
                            const StepList     &steps)
    {
      if constexpr (dim == 2)
        if (scene.crack_tip.stress_intensity)
          return std::make_unique<const CrackTipAnalysis>(scene,
                                                          body,
                                                          split,
                                                          steps);
      return nullptr;
    }



    std::vector<Observer *>
    together(std::vector<Observer *>        some,
             const std::vector<Observer *> &others)
    {
      some.insert(some.end(), others.begin(), others.end());
      return some;
    }
  } // namespace



  template <int dim>
  Simulation<dim>::Simulation(const Scene                     &scene,
                              std::shared_ptr<const Mesh<dim>> mesh,
                              Log                             &log)
    : scene(scene)
    , communicator(mesh->get_communicator())
    , log(log)
    // Of this rank alone: with a communicator it would talk while an exception
    // is on its way.
    , phases(std::cout, TimerOutput::never, TimerOutput::wall_times)
    , body(scene, std::move(mesh))
    , recovery(body.space, body.points)
    , probes(make_probes(scene.output.probes, body.space, recovery, body.lip))
    , steps(scene.time_integration,
            scene.loads.period,
            scene.output.field_times)
    , integrator(body.effects.viscosity.on
                   ? make_integrator(scene.time_integration,
                                     scene.loads.period,
                                     body.effects.contact.on)
                   : nullptr)
    , relaxation_times(
        survey(body, survey_instants(steps, integrator.get()), steps.period()))
    , largest_thermal_strain(body.material.largest_thermal_strain(
        survey_instants(steps, integrator.get())))
    , largest_nodal_force(largest_load(body, steps))
    , missed_load(load_missed_by_steps(body, steps))
    , periodic_choice(choose_with_jumps(scene,
                                        body,
                                        steps,
                                        relaxation_times,
                                        largest_nodal_force))
    , secular_split(
        choose_secular_split(scene,
                             body,
                             steps,
                             integrator.get(),
                             periodic_choice.needs_periodic_strain()))
    , crack_tip(
        make_crack_tip_analysis<dim>(this->scene, body, secular_split, steps))
  {
    if (scene.output.elastic_comparison != "none")
      // Throws if there is nothing to compare with.
      load_factors(body,
                   steps,
                   integrator.get(),
                   scene.output.elastic_comparison);

    if (integrator != nullptr)
      step_control = make_step_control(scene.time_integration,
                                       steps,
                                       *integrator,
                                       relaxation_times.smallest);
    else
      step_control = std::make_unique<FixedSteps>();
  }



  template <int dim>
  void
  Simulation<dim>::run(const std::string             &directory,
                       RunState                      &state,
                       Leg                           &leg,
                       const std::vector<Observer *> &others,
                       Summary                        summary,
                       Checkpoints                   &checkpoints)
  {
    timer.restart();
    Solvers<dim> solvers(scene, body, steps, largest_nodal_force, log, phases);
    solvers.add(state.solvers);
    rate_evaluations = state.rate_evaluations;

    const bool any_periods = scene.periodic_state.maximum_periods > 0;
    checkpoints.requests().stop_if_asked();
    std::optional<FourierResult> direct;
    if (any_periods)
      {
        direct = solve_directly(solvers);
        if (direct && periodic_choice.method == "fourier")
          take_flow(*direct);
        else if (secular_split.effect.on)
          find_secular_flow(solvers);
      }
    if (!scene.contact.relaxation_table.empty() && !state.has_tables())
      write_relaxation_table(scene, body, solvers, steps, log, directory);
    // Where nothing is marched, no tables are begun either.
    if (any_periods)
      compute_periods(solvers,
                      direct ? &*direct : nullptr,
                      others,
                      directory,
                      state,
                      leg,
                      summary,
                      checkpoints);
    else
      {
        leg.ends_run = true;
        summarise(summary, solvers);
      }
    state.solvers          = solvers.statistics();
    state.rate_evaluations = rate_evaluations;
    for (const auto &[name, seconds] :
         phases.get_summary_data(TimerOutput::total_wall_time))
      state.seconds[name] += seconds;
    state.seconds["total"] += timer.wall_time();
    if (!leg.ends_run)
      return;
    if (direct)
      direct->add_to(summary);
    // By which --resume tells whether they are of the scene that is asked for.
    if (checkpoints.is_on())
      summary["scene"] = checkpoints.scene();
    write(summary, state, directory);
    conclude(state.result, checkpoints.is_on());
    if (state.result.converged)
      {
        require_contact_forces(summary);
        require_lip_at_rest(summary);
      }
  }



  template <int dim>
  void
  Simulation<dim>::compute_periods(Solvers<dim>                  &solvers,
                                   const FourierResult           *direct,
                                   const std::vector<Observer *> &others,
                                   const std::string             &directory,
                                   RunState                      &state,
                                   Leg                           &leg,
                                   Summary                       &summary,
                                   Checkpoints                   &checkpoints)
  {
    Outputs<dim> outputs(scene,
                         body,
                         recovery,
                         probes,
                         solvers,
                         steps,
                         integrator.get(),
                         crack_tip.get(),
                         secular_flow ? &*secular_flow : nullptr,
                         periodic_choice.periods_are_iterates(),
                         state,
                         log,
                         directory);
    checkpoints.set_tables(outputs.tables());
    search(solvers,
           direct,
           together(outputs.observers(), others),
           state,
           leg,
           checkpoints);
    outputs.hand_over(state);
    if (!leg.ends_run)
      return;
    summarise(summary, solvers);
    outputs.finish(summary);
    if (body.effects.viscosity.on)
      {
        stress_rounding                           = outputs.stress_rounding();
        summary["certificate"]["stress_rounding"] = stress_rounding;
      }
    summarise_secular_flow(summary);
  }



  template <int dim>
  void
  Simulation<dim>::write(Summary           &summary,
                         RunState          &state,
                         const std::string &directory) const
  {
    const PeriodicResult &result     = state.result;
    summary["stress_change"]         = result.stress_change;
    summary["stress_error_estimate"] = result.stress_error_estimate;
    summary["periods"]               = result.periods;
    summary["converged"]             = // null: nothing was marched
      result.periods > 0 ? Summary(result.converged) : Summary();
    const double total = state.seconds["total"];
    for (const auto &[name, seconds] : state.seconds)
      if (name != "total")
        summary["seconds"][name] = seconds;
    summary["seconds"]["total"] = total;
    summary["processor_seconds"] =
      Utilities::MPI::max(state.timer.cpu_time(), communicator);
    const std::vector<double> peaks = peak_memory_of_ranks(communicator);
    if (!peaks.empty())
      {
        summary["peak_memory_bytes"] =
          *std::max_element(peaks.begin(), peaks.end());
        summary["peak_memory_bytes_of_ranks"] = peaks;
      }
    if (Utilities::MPI::this_mpi_process(communicator) == 0)
      write_summary(summary, directory + "/summary.json");

    char text[80];
    std::snprintf(text, sizeof(text), "  Time = %.2f s", total);
    log.line(text);
  }



  template <int dim>
  const Body<dim> &
  Simulation<dim>::discretised_body() const
  {
    return body;
  }



  template <int dim>
  void
  Simulation<dim>::find_secular_flow(Solvers<dim> &solvers)
  {
    TimerOutput::Scope phase(phases, "secular problem");
    try
      {
        secular_flow =
          solve_secular_problem(body, secular_split.mean_load, solvers);
      }
    catch (const NumericalError &error)
      {
        end_abandoned_factors();
        const std::string what =
          std::string(
            "the stationary contact problem for beta, with the "
            "viscosity for the stiffness, was not solved: ") +
          error.what();
        if (scene.periodic_state.secular_split == "on")
          throw NumericalError("[Periodic state] Secular split = on: " + what);
        if (secular_split.is_split && !periodic_choice.may_fall_back)
          throw NumericalError(what +
                               " [Periodic state] Method = march does "
                               "without.");
        if (secular_split.is_split)
          periodic_choice = {"march",
                             false,
                             true,
                             "automatic: the flow was not found"};
        // Nothing else of the run needs it.
        secular_split.is_split       = false;
        secular_split.strain_returns = false;
        secular_split.effect.on      = false;
        secular_split.effect.why     = what;
        log.line("  warning: " + what);
      }
  }



  template <int dim>
  void
  Simulation<dim>::take_flow(const FourierResult &direct)
  {
    secular_flow           = direct.flow;
    secular_split.is_split = direct.flow.has_value();
    if (direct.flow && !secular_split.effect.on)
      {
        secular_split.effect.on = true;
        secular_split.effect.why =
          "the mean of the samples does not vanish, "
          "though that of the load does";
        direct_warnings.push_back(
          "[Time integration] Steps per period: the mean load vanishes, but "
          "not that of its samples: what flows is an error of the steps");
        log.line("  warning: " + direct_warnings.back());
      }
    else if (!direct.flow)
      secular_split.effect.on = false;
  }



  template <int dim>
  std::optional<FourierResult>
  Simulation<dim>::solve_directly(Solvers<dim> &solvers)
  {
    if (!periodic_choice.uses_fourier())
      return {};
    TimerOutput::Scope phase(phases, "direct in time");
    try
      {
        FourierResult result = solve_fourier_problem(
          scene, body, steps, solvers, relaxation_times.smallest);
        for (const std::string &line : result.describe())
          log.line(line);
        for (const std::string &warning : result.warnings)
          log.line("  warning: " + warning);
        direct_warnings = result.warnings;
        if (periodic_choice.method != "fourier")
          result.keep_start();
        return result;
      }
    catch (const NumericalError &error)
      {
        if (!periodic_choice.may_fall_back)
          throw;
        end_abandoned_factors();
        log.line("  warning: the direct method failed, anderson takes over: " +
                 std::string(error.what()));
        periodic_choice.method = "anderson";
        return {};
      }
  }



  template <int dim>
  void
  Simulation<dim>::search(Solvers<dim>                  &solvers,
                          const FourierResult           *direct,
                          const std::vector<Observer *> &observers,
                          RunState                      &state,
                          Leg                           &leg,
                          Checkpoints                   &checkpoints)
  {
    checkpoints.requests().stop_if_asked();
    TimerOutput::Scope phase(phases, "time stepping");
    Evolution<dim>     evolution(body.strain_operator,
                             body.points,
                             body.loads,
                             solvers);
    KeptRun<dim>       kept(checkpoints,
                      body,
                      n_kept_stresses(),
                      last_period_of_search(),
                      [&](StateArchive &archive) {
                        serialize(state, solvers, evolution, archive);
                      });
    const StatePart    part(&kept, [&](StateArchive &archive) {
      solvers.serialize(archive);
    });
    PeriodMap<dim>     period_map(
      evolution, integrator.get(), *step_control, steps, &kept);
    if (secular_flow && secular_split.is_split)
      evolution.split_off(*secular_flow);
    if (integrator != nullptr &&
        scene.time_integration.step_control == "adaptive")
      evolution.set_scales(instants_of_scale(body, steps));
    if (state.displacement.size() > 0)
      solvers.current().contact_solver().start_from(
        touching_bounds(unilateral_bounds(body.lip, body.space),
                        state.displacement));
    state.result = PeriodicSearch<dim>(scene,
                                       body,
                                       periodic_choice,
                                       secular_split,
                                       secular_flow ? &*secular_flow : nullptr,
                                       direct,
                                       relaxation_times,
                                       log)
                     .run(
                       evolution,
                       period_map,
                       steps,
                       [&solvers]() { return solvers.statistics().vi_solves; },
                       observers,
                       state,
                       leg);
    rate_evaluations += evolution.n_rate_evaluations();
  }



  template class Simulation<2>;
  template class Simulation<3>;
} // namespace Crevasse
