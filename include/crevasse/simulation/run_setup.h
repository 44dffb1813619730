// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_simulation_run_setup_h
#define crevasse_simulation_run_setup_h

#include <crevasse/crack_tip/creep_integral.h>
#include <crevasse/model/largest_load.h>
#include <crevasse/model/linear_choice.h>
#include <crevasse/parameters/automatic.h>
#include <crevasse/periodic/periodic_choice.h>
#include <crevasse/postprocess/crack_front_analysis.h>
#include <crevasse/postprocess/crack_tip_analysis.h>
#include <crevasse/postprocess/load_factors.h>
#include <crevasse/postprocess/probe.h>
#include <crevasse/time/integrator_choice.h>
#include <crevasse/time/step_control.h>

namespace Crevasse
{
  /**
   * Set-up of a run on one mesh. Its construction checks mesh, boundaries,
   * formulas and step sizes, and makes all choices; it computes no states. A
   * set-up is constant.
   */
  template <int dim>
  struct RunSetup
  {
    /** Checks and chooses. Collective. @throw SceneError, or NumericalError if
     * steps are unstable. */
    RunSetup(const Scene &of_run, std::shared_ptr<const Mesh<dim>> mesh)
      : scene(of_run)
      , own_body(scene, std::move(mesh))
      , recovery(body.space,
                 body.points,
                 body.material.materials_of_cells(body.space, body.points))
      , probes(
          make_probes(Crevasse::probes(scene), body.space, recovery, body.lip))
      , steps(scene)
      , integrator(make_integrator())
    {
      // Instants at which a run evaluates formulas, and some between.
      const std::vector<double> instants = steps.survey_instants(
        integrator != nullptr ? integrator->properties.quadrature.nodes
                              : std::vector<double>());
      body.loads.validate_and_bound(instants);
      relaxation_times =
        body.material.relaxation_times(instants, steps.period());
      largest_thermal_strain = body.material.largest_thermal_strain(instants);
      largest_nodal_force    = largest_load(body, steps);
      own_body.lip.negligible_force = 1e-9 * largest_nodal_force;
      missed_load                   = load_missed_by_steps(body, steps);
      // Choices depend on the jumps.
      steps.set_jumps(find_jumps(scene, body, steps, largest_nodal_force));
      periodic_choice =
        choose_periodic_method(scene, body, steps, relaxation_times.largest);
      secular_split =
        choose_secular_split(scene,
                             body,
                             steps,
                             integrator.get(),
                             periodic_choice.needs_periodic_strain());
      solvers          = choose_solvers(scene, body);
      stress_intensity = body.effects.stress_intensity;
      if constexpr (dim == 2)
        {
          find_crack_tips();
          if (scene.crack_tip.creep_integral)
            for (const CrackTip &tip :
                 Crevasse::crack_tips(body.space.mesh(),
                                      body.space.roles,
                                      "[Crack tip] Creep integral = true"))
              {
                creep_integrals.push_back(std::make_unique<const CreepIntegral>(
                  scene, body, tip, recovery));
                require_no_force_at_tip(scene,
                                        body,
                                        creep_integrals.back()->region,
                                        steps);
              }
        }
      if constexpr (dim == 3)
        if (body.effects.stress_intensity.on)
          crack_front =
            std::make_unique<const CrackFrontAnalysis>(scene, body, steps);
      const ComparedLip compared = scene.output.elastic_comparison;
      if (compared != ComparedLip::none)
        load_factors =
          Crevasse::load_factors(body, steps, integrator.get(), compared);
      make_step_control(); // throws if steps are unstable
    }

    RunSetup(const RunSetup &) = delete;
    RunSetup &
    operator=(const RunSetup &) = delete;

    /** Creates an integrator for a run; null without viscosity. */
    std::unique_ptr<Integrator>
    make_integrator() const
    {
      if (!body.effects.viscosity.on)
        return nullptr;
      return Crevasse::make_integrator(scene.time_integration,
                                       body.effects.contact.on);
    }

    /** Creates the step control. @throw NumericalError if steps exceed the
     * stability limit of the integrator. */
    std::unique_ptr<StepControl>
    make_step_control() const
    {
      if (integrator == nullptr)
        return std::make_unique<StepControl>();
      return Crevasse::make_step_control(scene.time_integration,
                                         steps,
                                         integrator->properties,
                                         relaxation_times.smallest);
    }

    /** Effects of the scene, and the secular flow. */
    std::vector<Effects::Effect>
    active_effects(const SecularSplit &split) const
    {
      Effects all          = body.effects;
      all.secular_flow     = split.effect;
      all.stress_intensity = stress_intensity;
      return all.list();
    }

    const Scene scene;

  private:
    /** The body. Its lip's negligible force is set only after the surveys,
     * which first find formulas without a value. */
    Body<dim> own_body;

  public:
    const Body<dim>                        &body = own_body;
    const StressRecovery<dim>               recovery;
    const std::vector<ProbeEvaluator<dim>>  probes;
    StepList                                steps;      ///< steps of period 1
    const std::unique_ptr<const Integrator> integrator; ///< for properties
    RelaxationTimes                         relaxation_times;
    double                                  largest_thermal_strain;
    double                                  largest_nodal_force;
    double                                  missed_load; ///< missed by steps
    PeriodicChoice                          periodic_choice;
    Effects::Effect                         stress_intensity;
    SecularSplit                            secular_split;
    SolverChoice                            solvers;
    std::vector<std::unique_ptr<const CrackTipAnalysis>> crack_tips;
    std::vector<Summary> tips_without_intensity; ///< tips, and why ("no_K")
    std::vector<std::unique_ptr<const CreepIntegral>> creep_integrals;
    std::unique_ptr<const CrackFrontAnalysis>
                               crack_front;  ///< in space; null in a plane
    std::optional<LoadFactors> load_factors; ///< for the elastic comparison

  private:
    /** Finds the tips; "automatic" switches K off if no tip has a K. */
    void
    find_crack_tips()
    {
      if (!stress_intensity.on)
        return;
      try
        {
          crack_tips = analyse_crack_tips(
            scene, body, secular_split, steps, tips_without_intensity);
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
  };
} // namespace Crevasse

#endif
