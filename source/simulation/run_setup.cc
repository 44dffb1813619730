// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/model/largest_load.h>
#include <crevasse/model/linear_choice.h>
#include <crevasse/postprocess/elastic_reference.h>
#include <crevasse/simulation/run_setup.h>
#include <crevasse/time/integrator_choice.h>

namespace Crevasse
{
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
    validate_and_bound(const Body<dim>           &body,
                       const std::vector<double> &instants,
                       const double               period)
    {
      body.loads.validate_and_bound(instants, body.space.communicator());
      return body.material.validate_and_bound(instants, period);
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
  } // namespace



  template <int dim>
  RunSetup<dim>::RunSetup(const Scene                     &scene,
                          std::shared_ptr<const Mesh<dim>> mesh)
    : scene(scene)
    , body(scene, std::move(mesh))
    , recovery(body.space, body.points)
    , probes(make_probes(*scene.output.probes, body.space, recovery, body.lip))
    , steps(scene.time_integration,
            scene.loads.period,
            scene.output.field_times)
    , integrator(make_integrator())
    , relaxation_times(
        validate_and_bound(body,
                           survey_instants(steps, integrator.get()),
                           steps.period()))
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
    , solvers(choose_solvers(scene, body))
    , crack_tip(
        make_crack_tip_analysis<dim>(this->scene, body, secular_split, steps))
  {
    if (scene.output.elastic_comparison != ComparedLip::none)
      // Throws if there is nothing to compare with.
      load_factors(body,
                   steps,
                   integrator.get(),
                   scene.output.elastic_comparison);
    make_step_control(); // throws if steps are unstable
  }



  template <int dim>
  std::unique_ptr<Integrator>
  RunSetup<dim>::make_integrator() const
  {
    if (!body.effects.viscosity.on)
      return nullptr;
    return Crevasse::make_integrator(scene.time_integration,
                                     scene.loads.period,
                                     body.effects.contact.on);
  }



  template <int dim>
  std::unique_ptr<StepControl>
  RunSetup<dim>::make_step_control() const
  {
    if (integrator == nullptr)
      return std::make_unique<FixedSteps>();
    return Crevasse::make_step_control(scene.time_integration,
                                       steps,
                                       *integrator,
                                       relaxation_times.smallest);
  }



  template <int dim>
  std::vector<Effects::Effect>
  RunSetup<dim>::active_effects(const SecularSplit &split) const
  {
    Effects all      = body.effects;
    all.secular_flow = split.effect;
    return all.list();
  }



  template struct RunSetup<2>;
  template struct RunSetup<3>;
} // namespace Crevasse
