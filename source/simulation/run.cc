// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/problems.h>
#include <crevasse/base/text.h>
#include <crevasse/linear/mumps_instance.h>
#include <crevasse/simulation/run.h>
#include <crevasse/time/step_control.h>

namespace Crevasse
{
  using namespace dealii;

  namespace
  {
    /** Computes magnitudes of the scene, and sets data of body and steps that
     * depend on them. */
    template <int dim>
    Magnitudes
    find_magnitudes(const Scene      &scene,
                    const Integrator *integrator,
                    Body<dim>        &body,
                    StepList         &steps)
    {
      // Instants at which a run evaluates formulas, and some between.
      const std::vector<double> instants = steps.survey_instants(
        integrator != nullptr ? integrator->properties.quadrature.nodes
                              : std::vector<double>());
      body.loads.validate_and_bound(instants);
      Magnitudes magnitudes;
      magnitudes.relaxation_times =
        body.material.relaxation_times(instants, steps.period());
      magnitudes.largest_thermal_strain =
        body.material.largest_thermal_strain(instants);
      magnitudes.largest_nodal_force = largest_load(body, steps);
      body.lip.negligible_force      = 1e-9 * magnitudes.largest_nodal_force;
      magnitudes.missed_load         = load_missed_by_steps(body, steps);
      // Choices depend on the jumps.
      steps.set_jumps(
        find_jumps(scene, body, steps, magnitudes.largest_nodal_force));
      return magnitudes;
    }
  } // namespace



  template <int dim>
  Run<dim>::Run(const Scene                      &scene,
                const std::shared_ptr<Mesh<dim>> &mesh,
                Log                              &log,
                Checkpoints                      &checkpoints,
                RunState                         &state)
    : scene(scene)
    , log(log)
    , checkpoints(checkpoints)
    , state(state)
    , mesh(mesh)
    , own_body(scene, mesh)
    , recovery(body.space,
               body.points,
               body.material.materials_of_cells(body.space, body.points))
    , probes(make_probes(Crevasse::probes(scene),
                         body.space,
                         recovery,
                         body.lip,
                         &body.imposed))
    , steps(scene)
    , integrator(body.effects.viscosity.on
                   ? make_integrator(scene.time_integration,
                                     body.effects.contact.on,
                                     body.friction && body.law.creep == nullptr)
                   : nullptr)
    , magnitudes(find_magnitudes(scene, integrator.get(), own_body, steps))
    , solvers(choose_solvers(scene, body))
    , choice(choose_periodic_method(scene,
                                    body,
                                    steps,
                                    solvers.linear,
                                    magnitudes.relaxation_times.largest))
    , split(choose_secular_split(scene,
                                 body,
                                 steps,
                                 integrator.get(),
                                 choice.needs_periodic_strain()))
    , systems(scene, body, solvers, steps, magnitudes.largest_nodal_force, log)
    , evolution(body.strain_operator,
                body.points,
                body.loads,
                systems,
                scene.time_integration.newton_tolerance)
    , stress_intensity(body.effects.stress_intensity)
  {
    find_tips();
    check_quantity();
    const ComparedLip compared = scene.output.elastic_comparison;
    if (compared != ComparedLip::none)
      load_factors =
        Crevasse::load_factors(body, steps, integrator.get(), compared);
    if (integrator != nullptr)
      integrator = control_steps(std::move(integrator),
                                 scene.time_integration,
                                 steps,
                                 magnitudes.relaxation_times.smallest);
  }



  template <int dim>
  void
  Run<dim>::find_tips()
  {
    const std::string creep     = "[Crack tip] Creep integral = true";
    const auto        add_creep = [&](const auto &region) {
      creep_integrals.push_back(std::make_unique<const CreepIntegral<dim>>(
        scene, body, region, recovery));
    };
    if constexpr (dim == 2)
      {
        find_tips_with_intensity();
        if (scene.crack_tip.creep_integral)
          for (const CrackTip &tip :
               Crevasse::crack_tips(body.space.mesh(), body.space.roles, creep))
            {
              add_creep(TipRegion(body.space, tip));
              require_no_force_at_tip(scene,
                                      body,
                                      creep_integrals.back()->region,
                                      steps);
            }
      }
    else
      {
        if (stress_intensity.on)
          crack_front = std::make_unique<const CrackFrontAnalysis>(scene,
                                                                   body,
                                                                   split,
                                                                   steps);
        if (scene.crack_tip.creep_integral)
          {
            add_creep(FrontRegion(body.space, creep));
            require_no_force_at_front(
              scene, body, creep_integrals.back()->region, steps, creep);
          }
      }
  }



  template <int dim>
  void
  Run<dim>::check_quantity() const
  {
    const std::string &name   = scene.periodic_state.converged_quantity;
    const std::string setting = "[Periodic state] Converged quantity = " + name;
    if (name == "K_I" && crack_tips.empty() && crack_front == nullptr)
      throw SceneError(setting + ": there is no crack tip with K_I");
    if (name == "opening" && !body.effects.contact.on)
      throw SceneError(setting + ": there is no lip that may touch");
    if (name.rfind("probe ", 0) != 0)
      return;
    std::vector<std::string> names;
    for (const auto &probe : probes)
      {
        if (name == "probe " + probe.name)
          return;
        names.push_back(probe.name);
      }
    throw SceneError(setting + ": the names of [Output] Probes are " +
                     (names.empty() ? "none" : Text::join(names, ", ")));
  }



  template <int dim>
  void
  Run<dim>::find_tips_with_intensity()
  {
    if (!stress_intensity.on)
      return;
    try
      {
        if constexpr (dim == 2)
          crack_tips = analyse_crack_tips(
            scene, body, split, steps, tips_without_intensity);
        if (!crack_tips.empty())
          return;
        stress_intensity.why = tips_without_intensity.front()["no_K"];
        tips_without_intensity.clear();
      }
    catch (const SceneError &error)
      {
        if (scene.crack_tip.demands_stress_intensity())
          throw;
        stress_intensity.why = error.what();
      }
    stress_intensity.on = false;
  }



  template <int dim>
  std::vector<Effects::Effect>
  Run<dim>::active_effects() const
  {
    Effects all          = body.effects;
    all.secular_flow     = split.effect;
    all.stress_intensity = stress_intensity;
    return all.list();
  }



  template <int dim>
  void
  Run<dim>::find_secular_flow()
  {
    const Stopwatch phase("secular problem");
    try
      {
        flow = solve_secular_problem(body, split.mean_load, systems);
      }
    catch (const NumericalError &error)
      {
        end_abandoned_factors();
        const std::string what =
          std::string(
            "the stationary contact problem for beta, with viscosity instead "
            "of stiffness, was not solved: ") +
          error.what();
        if (scene.periodic_state.secular_split == SecularSplitType::on)
          throw NumericalError("[Periodic state] Secular split = on: " + what);
        if (split.is_split && (!choice.may_fall_back || body.imposed.flows))
          throw NumericalError(
            what +
            " Use [Periodic state] Method = march, which does not need it.");
        if (split.is_split)
          {
            choice               = PeriodicChoice();
            choice.may_fall_back = true;
            choice.why           = "automatic: the flow was not found";
          }
        // The rest of the run does not need the flow.
        split.is_split = split.strain_returns = split.effect.on = false;
        split.effect.why                                        = what;
        log.line("  warning: " + what);
        return;
      }
    if (scene.periodic_state.converged_quantity != "opening")
      return;
    const std::vector<double> rates = body.lip.opening_rates(flow->velocity);
    const double largest = *std::max_element(rates.begin(), rates.end());
    if (largest > 0.)
      throw NumericalError(
        Text::Message()
        << "[Periodic state] Converged quantity = opening: the mean load opens "
           "the lip by "
        << largest * steps.period()
        << " in each period, so that its opening is not periodic. Take stress, "
           "K_I or a probe.");
  }



  template <int dim>
  void
  Run<dim>::take_flow_of_samples()
  {
    const bool flows = direct->flow.has_value();
    flow             = direct->flow;
    split.is_split   = flows;
    if (flows && !split.effect.on)
      {
        split.effect.why =
          "the mean load vanishes, but the mean of its samples does not";
        later_warnings.emplace_back(
          "[Time integration] Steps per period: the mean load vanishes, but "
          "the mean of its samples does not: the secular flow is an error of "
          "the steps");
        log.line("  warning: " + later_warnings.back());
      }
    split.effect.on = flows;
  }



  template <int dim>
  void
  Run<dim>::balance_harmonics()
  {
    const Stopwatch phase("harmonic balance");
    try
      {
        FourierResult result = solve_fourier_problem(
          scene, body, steps, systems, magnitudes.relaxation_times.smallest);
        log.line(result.describe());
        for (const std::string &warning : result.warnings)
          log.line("  warning: " + warning);
        later_warnings = result.warnings;
        direct         = std::move(result);
      }
    catch (const NumericalError &error)
      {
        if (!choice.may_fall_back)
          throw;
        end_abandoned_factors();
        log.line("  warning: harmonic balance failed, anderson takes over: " +
                 std::string(error.what()));
        choice.method = PeriodicMethodType::anderson;
        choice.alternative.clear();
      }
  }



  template <int dim>
  void
  Run<dim>::prepare()
  {
    systems.add(state.solvers);
    log.line("  solver: " +
             systems.system_at(0.).contact_solver().description());
    if (!state.has_tables()) // later meshes: at a checkpoint
      checkpoints.requests.stop_if_asked();
    const bool any_periods = scene.periodic_state.maximum_periods > 0;
    if (any_periods && choice.method == PeriodicMethodType::fourier)
      balance_harmonics();
    if (direct && choice.method == PeriodicMethodType::fourier)
      take_flow_of_samples();
    else if (any_periods && split.effect.on)
      find_secular_flow();
    if (!scene.contact.relaxation_table.empty() && !state.has_tables())
      write_relaxation_table();
    if (any_periods) // without periods no tables are begun
      make_observers();
  }



  template class Run<2>;
  template class Run<3>;
} // namespace Crevasse
