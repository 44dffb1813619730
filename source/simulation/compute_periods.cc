// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/problems.h>
#include <crevasse/base/text.h>
#include <crevasse/checkpoint/checkpoint_writer.h>
#include <crevasse/discretisation/rigid_modes.h>
#include <crevasse/harmonic_balance/prescribed_motion.h>
#include <crevasse/model/largest_load.h>
#include <crevasse/periodic/anderson.h>
#include <crevasse/periodic/contraction.h>
#include <crevasse/periodic/march.h>
#include <crevasse/simulation/compute_periods.h>

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
    n_stresses_of_checkpoint(const RunSetup<dim>  &setup,
                             const PeriodicChoice &choice)
    {
      const unsigned int of_anderson =
        choice.method == PeriodicMethodType::anderson
          ? 2 * (setup.scene.periodic_state.anderson_depth + 2)
          : 0;
      const unsigned int n_branches = setup.body.law.branches.size();
      return setup.steps.n_steps() + 4 + 5 * n_branches +
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



    template <int dim>
    void
    prepare_evolution(Workspace<dim> &work)
    {
      const Body<dim>     &body  = work.setup.body;
      const PeriodicStart &start = work.start;
      Vector              &r     = work.state.viscous_strain;
      if (start.flow && start.split.is_split)
        work.evolution.split_off(*start.flow);
      if (work.integrator != nullptr &&
          (work.setup.scene.time_integration.step_control ==
             StepControlType::adaptive ||
           (work.integrator->properties.begins_explicitly &&
            body.law.is_power_law())))
        work.evolution.set_scales(body.space,
                                  instants_of_scale(body, work.steps));
      if (work.state.displacement.size() > 0)
        work.systems.system_at(0.).contact_solver().start_from(
          touching_bounds(unilateral_bounds(body.lip, body.space),
                          work.state.displacement));
      if (start.direct)
        r = start.direct->motion.viscous_strain.front();
      else if (body.effects.viscosity.on && r.size() == 0)
        body.points.initialize(r, body.law.branches.size());
    }



    /** Shows the period found, and compares it with its states: not converged
     * if they differ and another method may replace it. */
    template <int dim>
    PeriodicResult
    show_motion(Workspace<dim>                &work,
                const std::vector<Observer *> &observers,
                Checkpointer                  &checkpointer)
    {
      const SearchLimits   limits{1, 1e-8};
      const FourierResult &direct = *work.start.direct;
      StepControl          as_they_are;
      PrescribedMotion     motion(
        direct.motion,
        direct.rule,
        work.steps.step(0),
        RigidParts<dim>(work.setup.body.space.mesh()).size(),
        work.setup.largest_nodal_force);
      std::vector<Observer *> all = observers;
      all.push_back(&motion);
      ObservedPeriods<dim> periods(
        {work.evolution, &motion, as_they_are, work.steps, &checkpointer},
        all,
        limits);
      Vector r = direct.motion.viscous_strain.front();
      periods.begins_another(r);
      periods.compute(r);
      periods.finish(r);
      const double defect = motion.largest_defect();
      periods.report(defect);
      work.output.log.line(
        "  harmonic balance: states differ from periodic ones by " +
        Text::from_number(defect, 2) + " at most");
      const PeriodicResult &result = periods.result();
      if (!result.converged && !work.start.choice.may_fall_back)
        throw NumericalError(
          "[Periodic state] Method = fourier: the solution is not periodic: "
          "its states differ from those of the same viscous strain by " +
          Text::from_number(defect) +
          " of their size. Check for moduli or relaxation times that differ by "
          "many orders of magnitude, or use Method = anderson.");
      return result;
    }



    /** Creates the ReturnDefect of a period.
     * @param material at its beginning. @param bounds of the lip. Both must
     * outlive the result. */
    template <int dim>
    ReturnDefect<dim>
    return_defect(const Workspace<dim>     &work,
                  const MaterialState<dim> &material,
                  const UnilateralBounds   &bounds)
    {
      const PeriodicStart &start = work.start;
      return {work.setup.body.points.n_local_points,
              material,
              start.flow ? &*start.flow : nullptr,
              start.split.is_split,
              work.setup.relaxation_times.mean_fluidity_factor,
              work.setup.scene.loads.period,
              bounds};
    }



    /** Whether the viscous strain must return after a period. */
    template <int dim>
    bool
    requires_return(const Workspace<dim> &work)
    {
      const Body<dim> &body = work.setup.body;
      // Strain without stress matters to a march if a lip may touch.
      return body.effects.viscosity.on &&
             (work.start.split.strain_returns || body.law.has_spring()) &&
             (work.start.choice.method != PeriodicMethodType::march ||
              body.effects.contact.on);
    }



    template <int dim>
    void
    accelerate(Workspace<dim>       &work,
               ObservedPeriods<dim> &periods,
               const double          slowness)
    {
      const Body<dim> &body = work.setup.body;
      // A power law has no constant fluidity; the norm uses the stiffness.
      const ViscousCoordinates<dim> coordinates(
        body.space,
        body.points,
        body.material.at(0.),
        body.law.is_power_law()
          ? 0.
          : work.setup.scene.loads.period *
              work.setup.relaxation_times.mean_fluidity_factor);
      Anderson<dim> method(periods,
                           coordinates,
                           work.setup.scene.periodic_state,
                           slowness);
      method.run(work.state.viscous_strain);
      const auto &counts = method.counts();
      if (counts.shortened > 0)
        work.output.log.line(
          "  anderson combined fewer periods in " +
          std::to_string(counts.shortened) +
          " steps: the oldest ones led away from the periodic state");
      if (counts.leaps > 0)
        work.output.log.line("  anderson followed a steady drift by " +
                             std::to_string(counts.leaps) +
                             " steps of two and more periods");
    }



    template <int dim>
    void
    search(Workspace<dim> &work, ObservedPeriods<dim> &periods)
    {
      // Infinite if no stress relaxes; then stress does not change either.
      const double slowest = work.setup.relaxation_times.longest_in_mean;
      const double slowness =
        std::isfinite(slowest)
          ? slowness_of_relaxation(work.setup.scene.loads.period / slowest)
          : work.setup.relaxation_times.creep_exponent;
      if (work.start.choice.method != PeriodicMethodType::march)
        accelerate(work, periods, slowness);
      else
        march(periods,
              slowness,
              work.setup.relaxation_times.creep_exponent,
              work.state.viscous_strain);
    }
  } // namespace



  template <int dim>
  void
  compute_periods(Workspace<dim>                &work,
                  const std::vector<Observer *> &observers)
  {
    const Stopwatch                phase("time stepping");
    const Body<dim>               &body       = work.setup.body;
    const PeriodicStart           &start      = work.start;
    const PeriodicStateParameters &parameters = work.setup.scene.periodic_state;
    RunState                      &state      = work.state;

    CheckpointWriter<dim>    writer(work.output.checkpoints,
                                 body,
                                 n_stresses_of_checkpoint(work.setup,
                                                          start.choice),
                                 parameters,
                                 [&work](StateArchive &archive) {
                                   work.state.solvers =
                                     work.systems.statistics();
                                   work.state.serialize(archive);
                                 });
    const SerializationScope systems(&writer, [&work](StateArchive &archive) {
      work.systems.serialize(archive);
    });
    prepare_evolution(work);

    const bool shows =
      start.choice.method == PeriodicMethodType::fourier && start.direct;
    PeriodicResult before = state.result;
    if (shows && !state.fourier_failed)
      {
        before = show_motion(work, observers, writer);
        if (before.converged)
          {
            state.result         = before;
            state.stage.ends_run = true;
            return;
          }
        work.output.log.line("  anderson takes over");
        state.fourier_failed = true;
      }
    if (shows)
      work.start.choice.method = PeriodicMethodType::anderson;

    const UnilateralBounds   bounds   = unilateral_bounds(body.lip, body.space);
    const MaterialState<dim> material = body.material.at(0.);
    const ReturnDefect<dim>  defect   = return_defect(work, material, bounds);
    ObservedPeriods<dim>     periods({work.evolution,
                                      work.integrator.get(),
                                      *work.step_control,
                                      work.steps,
                                      &writer},
                                 observers,
                                 {std::min(parameters.maximum_periods,
                                           state.stage.last_period),
                                      parameters.tolerance},
                                 before,
                                 !state.has_begun(),
                                 requires_return(work) ? &defect : nullptr);
    search(work, periods);
    state.result         = periods.result();
    state.stage.ends_run = state.result.converged ||
                           state.result.periods < state.stage.last_period ||
                           state.result.periods >= parameters.maximum_periods;
    periods.finish(state.viscous_strain, state.stage.ends_run);
    if (!state.stage.ends_run) // start of the next stage
      state.displacement = work.evolution.state().displacement;
  }



  template decltype(compute_periods<2>) compute_periods<2>;
  template decltype(compute_periods<3>) compute_periods<3>;
} // namespace Crevasse
