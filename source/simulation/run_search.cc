// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/problems.h>
#include <crevasse/base/text.h>
#include <crevasse/checkpoint/checkpoint_writer.h>
#include <crevasse/discretisation/rigid_modes.h>
#include <crevasse/harmonic_balance/prescribed_motion.h>
#include <crevasse/model/largest_load.h>
#include <crevasse/periodic/anderson.h>
#include <crevasse/periodic/averaged.h>
#include <crevasse/periodic/contraction.h>
#include <crevasse/periodic/march.h>
#include <crevasse/periodic/missions.h>
#include <crevasse/simulation/run.h>

namespace Crevasse
{
  using namespace dealii;

  namespace
  {
    /** Largest number of fields of the size of a stress in a checkpoint:
     * stresses at the instants of a period, viscous strain, rates, and the
     * memory of Anderson acceleration. */
    template <int dim>
    unsigned int
    n_stresses_of_checkpoint(const Run<dim> &run)
    {
      const unsigned int of_anderson =
        run.choice.periods_are_iterates()
          ? 2 * (run.scene.periodic_state.anderson_depth + 2)
          : 0;
      const unsigned int n_branches = run.body.law.branches.size();
      return run.steps.n_steps() + 4 + 5 * n_branches +
             of_anderson * n_branches;
    }



    /** Marks the bounds that a displacement touches. */
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



    /** Cell, material and relaxation time where the stress changed most in the
     * last period. Collective. */
    template <int dim>
    std::string
    place_of_change(const Body<dim>     &body,
                    const StepList      &steps,
                    const StressHistory &stresses)
    {
      const StressHistory::Place here = stresses.place();
      const unsigned int         point =
        here.entry / QuadratureField<dim>::n_components;
      const bool is_known = here.entry != numbers::invalid_unsigned_int;
      const bool relaxes =
        is_known && body.effects.viscosity.on && body.law.creep == nullptr;
      double relaxed = 0.; // over the period, of the slowest branch
      for (unsigned int k = 0; relaxes && k < steps.n_steps(); ++k)
        {
          const MaterialState<dim> now = body.material.at(steps.instant(k));
          double least = std::numeric_limits<double>::infinity();
          for (unsigned int i = 0; i < now.fluidity.size(); ++i)
            least = std::min(least,
                             now.fractions[i] *
                               relaxation_rates<dim>((*now.fluidity[i])[point],
                                                     (*now.stiffness)[point])
                                 .least);
          relaxed += now.kappa(steps.step(k)) * least;
        }
      std::string text;
      for (const auto &cell : owned_cells(body.space.dof_handler))
        if (const std::size_t first = body.points.first_point(cell);
            is_known && first <= point &&
            point < first + body.space.quadrature(cell).size())
          {
            text = "at " + Text::from_point(cell->center()) + ", in material " +
                   std::to_string(cell->material_id());
            if (relaxed > 0.)
              text += ", whose relaxation time is " +
                      Text::from_number(1. / relaxed, 3) + " periods";
          }
      using Places = std::vector<std::pair<double, std::string>>;
      const Places places =
        Utilities::MPI::all_gather(body.space.communicator(),
                                   std::make_pair(here.change, text));
      return std::max_element(places.begin(), places.end())->second;
    }
  } // namespace



  template <int dim>
  void
  Run<dim>::prepare_evolution()
  {
    Vector &r = state.viscous_strain;
    evolution.slide_with(body.friction);
    if (flow && split.is_split)
      evolution.split_off(*flow);
    if (integrator != nullptr &&
        (scene.time_integration.step_control == StepControlType::adaptive ||
         (integrator->properties.begins_explicitly &&
          body.law.creep != nullptr)))
      evolution.set_scales(body.space, instants_of_scale(body, steps));
    if (state.displacement.size() > 0)
      systems.system_at(0.).contact_solver().start_from(
        touching_bounds(unilateral_bounds(body.lip, body.space),
                        state.displacement));
    if (direct)
      r = direct->motion.viscous_strain.front();
    else if (body.effects.viscosity.on && r.size() == 0)
      body.points.initialize(r, body.law.branches.size());
  }



  template <int dim>
  PeriodicResult
  Run<dim>::show_motion(std::vector<Observer *> all, Checkpointer &writer)
  {
    PrescribedMotion motion(direct->motion,
                            direct->rule,
                            steps.step(0),
                            RigidParts<dim>(body.space.mesh()).size(),
                            magnitudes.largest_nodal_force);
    all.push_back(&motion);
    ObservedPeriods<dim> periods(
      evolution, &motion, steps, all, writer, {1, 1e-8});
    Vector r = direct->motion.viscous_strain.front();
    periods.begins_another(r);
    periods.compute(r);
    periods.finish(r);
    const double defect = motion.largest_defect();
    periods.report(defect);
    log.line("  harmonic balance: states differ from periodic ones by " +
             Text::from_number(defect, 2) + " at most");
    const PeriodicResult &result = periods.result();
    if (!result.converged && !choice.may_fall_back)
      throw NumericalError(
        "[Periodic state] Method = fourier: the solution is not periodic: "
        "its states differ from those of the same viscous strain by " +
        Text::from_number(defect) +
        " of their size. Check for moduli or relaxation times that differ by "
        "many orders of magnitude, or use Method = anderson.");
    return result;
  }



  template <int dim>
  void
  Run<dim>::accelerate(ObservedPeriods<dim> &periods, const double slowness)
  {
    // Nonlinear creep has no constant fluidity; the norm uses the stiffness.
    const ViscousCoordinates<dim> coordinates(
      body.space,
      body.points,
      body.material.at(0.),
      body.law.creep != nullptr
        ? 0.
        : scene.loads.period *
            magnitudes.relaxation_times.mean_fluidity_factor);
    Anderson<dim> method(periods, coordinates, scene.periodic_state, slowness);
    method.run(state.viscous_strain);
    if (method.n_shortened() > 0)
      log.line("  anderson combined fewer periods in " +
               std::to_string(method.n_shortened()) +
               " steps: the oldest ones led away from the periodic state");
  }



  template <int dim>
  void
  Run<dim>::use_average(ObservedPeriods<dim>   &periods,
                        const UnilateralBounds &bounds)
  {
    const PeriodicStateParameters &parameters = scene.periodic_state;
    AveragedPeriods<dim>           averaged(periods,
                                  evolution,
                                  body,
                                  bounds,
                                  systems,
                                  parameters.missions.empty()
                                              ? parameters.averaged_poles
                                              : 0);
    constexpr double many = 1e4; // periods in the life of a component
    const double     slowest =
      magnitudes.relaxation_times.longest_in_mean / scene.loads.period;
    if (parameters.missions.empty() && slowest > many && std::isfinite(slowest))
      log.line("  the slowest part relaxes in " +
               Text::from_number(slowest, 2) +
               " periods, and no component lives so long. [Periodic state] "
               "Missions computes the state at given ages");
    if (parameters.missions.empty())
      Averaged<dim>(periods, averaged, parameters.anderson_depth)
        .run(state.viscous_strain);
    else
      Missions<dim>(periods,
                    averaged,
                    parameters.missions,
                    parameters.mission_tolerance)
        .run(state.viscous_strain);
    if (averaged.n_unsolved() > 0)
      log.line("  averaged: " + std::to_string(averaged.n_unsolved()) +
               " times no shift of the lip gives the mean contact forces, and "
               "the nearest one was taken");
  }



  template <int dim>
  bool
  Run<dim>::search()
  {
    const PeriodicStateParameters &parameters = scene.periodic_state;
    if (parameters.maximum_periods == 0)
      return true;
    const Stopwatch    phase("time stepping");
    const auto        &growth      = *scene.geometry.crack_growth;
    const auto         next        = growth.upper_bound(state.result.periods);
    const unsigned int last_period = // on this mesh
      scene.refinement.readapt_every > 0
        ? state.result.periods + scene.refinement.readapt_every
      : next != growth.end() ? next->first
                             : std::numeric_limits<unsigned int>::max();
    std::vector<Observer *> all;
    for (const auto &observer : observers)
      all.push_back(observer.get());
    if (scene.refinement.readapt_every > 0)
      {
        estimate = std::make_unique<PeriodEstimate<dim>>(scene,
                                                         body,
                                                         steps,
                                                         last_period);
        all.push_back(estimate.get());
      }

    CheckpointWriter<dim>    writer(checkpoints,
                                 body,
                                 *mesh,
                                 n_stresses_of_checkpoint(*this),
                                 parameters,
                                 [this](StateArchive &archive) {
                                   state.solvers = evolution.statistics();
                                   state.serialize(archive);
                                 });
    const SerializationScope of_systems(&writer, [this](StateArchive &archive) {
      systems.serialize(archive);
    });
    prepare_evolution();

    const bool shows = choice.method == PeriodicMethodType::fourier && direct;
    PeriodicResult before = state.result;
    if (shows && !state.method_failed)
      {
        before = show_motion(all, writer);
        if (before.converged)
          {
            state.result = before;
            return true;
          }
        log.line("  anderson takes over");
        state.method_failed = true;
      }
    if (shows)
      choice.method = PeriodicMethodType::anderson;
    if (choice.method != PeriodicMethodType::averaged ||
        !choice.may_fall_back || parameters.tolerance == 0.)
      return find_periodic_state(all, writer, before, last_period);
    if (!state.method_failed)
      {
        // Four times what the hardest of the random bodies took.
        constexpr unsigned int enough = 40;
        if (find_periodic_state(all, writer, before, before.periods + enough))
          return true;
        log.line(
          "  the averaged body does not lead to the periodic state: "
          "march takes over");
        state.method_failed = true;
        before              = state.result;
      }
    choice.method = PeriodicMethodType::march;
    return find_periodic_state(all, writer, before, last_period);
  }



  template <int dim>
  bool
  Run<dim>::find_periodic_state(const std::vector<Observer *> &all,
                                Checkpointer                  &writer,
                                const PeriodicResult          &before,
                                const unsigned int             last_period)
  {
    const PeriodicStateParameters &parameters = scene.periodic_state;
    const RelaxationTimes         &times      = magnitudes.relaxation_times;
    const UnilateralBounds   bounds   = unilateral_bounds(body.lip, body.space);
    const MaterialState<dim> material = body.material.at(0.);
    const ReturnDefect<dim>  defect{body.points.n_local_points,
                                   material,
                                   flow ? &*flow : nullptr,
                                   split.is_split,
                                   times.mean_fluidity_factor,
                                   scene.loads.period,
                                   bounds};
    ObservedPeriods<dim>     periods(
      evolution,
      integrator.get(),
      steps,
      all,
      writer,
      {std::min(parameters.maximum_periods, last_period),
       parameters.missions.empty() ? parameters.tolerance : 0.,
           quantity});
    periods.continue_from(before, !state.has_begun());
    // Strain without stress matters to a march if a lip may touch. With
    // friction only chains with a spring return, where all strain causes
    // stress.
    if (body.effects.viscosity.on && !body.friction &&
        (split.strain_returns || body.law.has_spring()) &&
        choice.method != PeriodicMethodType::averaged &&
        (choice.method != PeriodicMethodType::march || body.effects.contact.on))
      periods.require_return(defect);
    if (net_slip != nullptr)
      periods.require_net_slip(*net_slip);
    // Infinite if no stress relaxes; then stress does not change either.
    const double slowness =
      std::isfinite(times.longest_in_mean)
        ? slowness_of_relaxation(scene.loads.period / times.longest_in_mean)
        : times.creep_exponent;
    if (choice.method == PeriodicMethodType::averaged)
      use_average(periods, bounds);
    else if (choice.method != PeriodicMethodType::march)
      accelerate(periods, slowness);
    else
      march(periods, slowness, times.creep_exponent, state.viscous_strain);

    state.result = periods.result();
    if (!state.result.converged && periods.remembers())
      state.result.place = place_of_change(body, steps, periods.stresses());
    const bool ends = state.result.converged ||
                      state.result.periods < last_period ||
                      state.result.periods >= parameters.maximum_periods;
    periods.finish(state.viscous_strain, ends);
    if (!ends) // start on the next mesh
      {
        state.displacement = evolution.state().displacement;
        state.solvers      = evolution.statistics();
      }
    return ends;
  }



  // Other members here are instantiated by their calls.
  template bool
  Run<2>::search();
  template bool
  Run<3>::search();
} // namespace Crevasse
