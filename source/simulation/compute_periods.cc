// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/problems.h>
#include <crevasse/base/text.h>
#include <crevasse/checkpoint/checkpoint_writer.h>
#include <crevasse/harmonic_balance/prescribed_motion.h>
#include <crevasse/model/largest_load.h>
#include <crevasse/periodic/anderson.h>
#include <crevasse/periodic/contraction.h>
#include <crevasse/periodic/march.h>
#include <crevasse/simulation/compute_periods.h>

#include <deal.II/grid/grid_tools.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace Crevasse
{
  using namespace dealii;

  namespace
  {
    /** How many fields of the size of a stress a checkpoint may have: stress at
     * the instants of a period, viscous strain and rates, and what Anderson's
     * method remembers. */
    template <int dim>
    unsigned int
    n_stresses_of_checkpoint(const RunSetup<dim>  &setup,
                             const PeriodicChoice &choice)
    {
      const unsigned int of_anderson =
        choice.method == PeriodicMethodType::anderson
          ? 2 * (setup.scene.periodic_state.anderson_depth + 2)
          : 0;
      const unsigned int n_branches = setup.body.law.branches().size();
      return setup.steps.n_steps() + 4 + 5 * n_branches +
             of_anderson * n_branches;
    }



    /** After which more may be wanted, for a periodic state is; or 0. */
    unsigned int
    last_period_of_search(const PeriodicStateParameters &parameters)
    {
      return parameters.tolerance > 0. ? parameters.maximum_periods : 0;
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



    const SecularFlow *
    flow_of(const PeriodicStart &start)
    {
      return start.flow ? &*start.flow : nullptr;
    }



    template <int dim>
    void
    prepare_evolution(const RunSetup<dim> &setup,
                      Workspace<dim>      &work,
                      RunState            &state)
    {
      const Body<dim> &body = setup.body;
      if (work.start.flow && work.start.split.is_split)
        work.evolution.split_off(*work.start.flow);
      if (work.integrator != nullptr &&
          setup.scene.time_integration.step_control ==
            StepControlType::adaptive)
        work.evolution.set_scales(instants_of_scale(body, work.steps));
      if (state.displacement.size() > 0)
        work.systems.system_at(0.).contact_solver().start_from(
          touching_bounds(unilateral_bounds(body.lip, body.space),
                          state.displacement));
      if (work.start.direct)
        state.viscous_strain = work.start.direct->motion.viscous_strain.front();
      else if (body.effects.viscosity.on && state.viscous_strain.size() == 0)
        body.points.initialize(state.viscous_strain,
                               body.law.branches().size());
    }



    /** Shows the period that was found, and compares it with its states: not
     * converged if they differ and another method may take over. */
    template <int dim>
    PeriodicResult
    show_motion(const RunSetup<dim>           &setup,
                Workspace<dim>                &work,
                const std::vector<Observer *> &observers,
                Checkpointer                  &checkpointer,
                Log                           &log)
    {
      constexpr double        tolerable = 1e-8;
      const FourierResult    &direct    = *work.start.direct;
      StepControl             as_they_are;
      PrescribedMotion        motion(direct.motion,
                              direct.rule,
                              work.steps.step(0),
                              GridTools::diameter(setup.body.space.mesh()),
                              setup.largest_nodal_force);
      std::vector<Observer *> all = observers;
      all.push_back(&motion);
      ObservedPeriods<dim> periods(
        {work.evolution, &motion, as_they_are, work.steps, &checkpointer},
        [&work]() { return work.systems.statistics().vi_solves; },
        all,
        1);
      Vector r = direct.motion.viscous_strain.front();
      periods.compute(r);
      periods.finish(r);
      const double defect = motion.largest_defect();
      periods.report(defect);
      log.line("  harmonic balance: states and samples differ by " +
               Text::from_number(defect) + " at most");
      PeriodicResult result = periods.result();
      result.converged      = defect <= tolerable;
      if (!result.converged && !work.start.choice.may_fall_back)
        throw NumericalError(
          "[Periodic state] Method = fourier: the periodic motion that was "
          "found "
          "is not one: its states differ from those of the same viscous strain "
          "by " +
          Text::from_number(defect) +
          " of their size. Look for moduli or relaxation times that differ by "
          "many orders of magnitude, or use Method = anderson.");
      return result;
    }



    /** Nothing if the viscous strain need not come back, or nobody asks. */
    template <int dim>
    std::optional<ReturnDefect<dim>>
    return_defect(const RunSetup<dim>      &setup,
                  const PeriodicStart      &start,
                  const MaterialState<dim> &material,
                  const UnilateralBounds   &bounds)
    {
      const Body<dim> &body = setup.body;
      const bool       returns =
        body.effects.viscosity.on &&
        (start.split.strain_returns || body.law.has_spring());
      // What bears no stress matters to a march where a lip may touch.
      if (!returns || (start.choice.method == PeriodicMethodType::march &&
                       !body.effects.contact.on))
        return {};
      return ReturnDefect<dim>{body.points.n_local_points(),
                               material,
                               flow_of(start),
                               start.split.is_split,
                               setup.relaxation_times.mean_fluidity_factor,
                               setup.scene.loads.period,
                               bounds};
    }



    /** See Anderson. */
    template <int dim>
    double
    slowness(const RunSetup<dim> &setup)
    {
      // Infinite where nothing relaxes; what does not relax does not change
      // either.
      const double slowest = setup.relaxation_times.longest_in_mean;
      return std::isfinite(slowest)
               ? slowness_of_relaxation(setup.scene.loads.period / slowest)
               : 1.;
    }



    template <int dim>
    ConvergenceStatus
    accelerate(const RunSetup<dim>  &setup,
               const bool            may_fall_back,
               ObservedPeriods<dim> &periods,
               Log                  &log,
               Vector               &r)
    {
      const EnergyCoordinates<dim> coordinates(setup.body.space,
                                               setup.body.points,
                                               setup.body.material.at(0.));
      Anderson<dim>                method(periods,
                           coordinates,
                           setup.scene.periodic_state,
                           slowness(setup),
                           may_fall_back);
      const ConvergenceStatus      status = method.run(r);
      if (const unsigned int n = method.n_restarts(); n > 0)
        log.line("  anderson began anew " +
                 (n == 1 ? "once" : std::to_string(n) + " times") +
                 ": residuals did not fall, or a step went astray");
      return status;
    }



    /** The state at the end of the last period: seen by the observers if the
     * run ends, or else where the next stage begins. */
    template <int dim>
    void
    finish_stage(ObservedPeriods<dim> &periods,
                 const Evolution<dim> &evolution,
                 const unsigned int    maximum_periods,
                 RunState             &state)
    {
      const PeriodicResult &result = state.result;
      state.stage.ends_run         = result.converged ||
                             result.periods < state.stage.last_period ||
                             result.periods >= maximum_periods;
      periods.finish(state.viscous_strain, state.stage.ends_run);
      if (!state.stage.ends_run)
        state.displacement = evolution.state().displacement;
    }
  } // namespace



  template <int dim>
  void
  compute_periods(const RunSetup<dim>           &setup,
                  Workspace<dim>                &work,
                  const RunOutput               &output,
                  const std::vector<Observer *> &observers,
                  RunState                      &state)
  {
    output.checkpoints.requests().stop_if_asked();
    TimerOutput::Scope             phase(work.phases, "time stepping");
    const PeriodicStart           &start      = work.start;
    const PeriodicStateParameters &parameters = setup.scene.periodic_state;

    CheckpointWriter<dim>    writer(output.checkpoints,
                                 setup.body,
                                 n_stresses_of_checkpoint(setup, start.choice),
                                 last_period_of_search(parameters),
                                 [&](StateArchive &archive) {
                                   work.add_to(state).serialize(archive);
                                 });
    const SerializationScope systems(&writer, [&](StateArchive &archive) {
      work.systems.serialize(archive);
    });
    prepare_evolution(setup, work, state);

    const bool shows =
      start.choice.method == PeriodicMethodType::fourier && start.direct;
    PeriodicResult before = state.result;
    if (shows && state.methods_left == 0)
      {
        before = show_motion(setup, work, observers, writer, output.log);
        if (before.converged)
          {
            state.result         = before;
            state.stage.ends_run = true;
            return;
          }
        output.log.line("  anderson takes over");
        ++state.methods_left;
      }

    const UnilateralBounds bounds =
      unilateral_bounds(setup.body.lip, setup.body.space);
    const MaterialState<dim> material = setup.body.material.at(0.);
    const auto           defect = return_defect(setup, start, material, bounds);
    ObservedPeriods<dim> periods(
      {work.evolution,
       work.integrator.get(),
       *work.step_control,
       work.steps,
       &writer},
      [&work]() { return work.systems.statistics().vi_solves; },
      observers,
      std::min(parameters.maximum_periods, state.stage.last_period),
      before,
      !state.has_begun(),
      defect ? &*defect : nullptr);

    Vector    &r              = state.viscous_strain;
    const auto march_to_limit = [&]() {
      return march(periods, parameters.tolerance, slowness(setup), r);
    };
    const unsigned int left_at_last = shows ? 2 : 1;
    ConvergenceStatus  status       = ConvergenceStatus::stagnant;
    if (start.choice.method == PeriodicMethodType::march)
      status = march_to_limit();
    else if (state.methods_left < left_at_last)
      status =
        accelerate(setup, start.choice.may_fall_back, periods, output.log, r);
    if (status == ConvergenceStatus::stagnant && start.choice.may_fall_back)
      {
        if (state.methods_left < left_at_last)
          output.log.line("  anderson stagnates: march");
        state.methods_left = left_at_last;
        status             = march_to_limit();
      }
    state.result           = periods.result();
    state.result.converged = status == ConvergenceStatus::converged;
    finish_stage(periods, work.evolution, parameters.maximum_periods, state);
  }



  template void
  compute_periods<2>(const RunSetup<2> &,
                     Workspace<2> &,
                     const RunOutput &,
                     const std::vector<Observer *> &,
                     RunState &);
  template void
  compute_periods<3>(const RunSetup<3> &,
                     Workspace<3> &,
                     const RunOutput &,
                     const std::vector<Observer *> &,
                     RunState &);
} // namespace Crevasse
