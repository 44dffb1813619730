// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/problems.h>
#include <crevasse/base/text.h>
#include <crevasse/harmonic_balance/given_motion.h>
#include <crevasse/model/largest_load.h>
#include <crevasse/periodic/anderson.h>
#include <crevasse/periodic/contraction.h>
#include <crevasse/periodic/march.h>
#include <crevasse/periodic/periodic_search.h>

#include <deal.II/grid/grid_tools.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace Crevasse
{
  template <int dim>
  PeriodicSearch<dim>::PeriodicSearch(const Scene           &scene,
                                      const Body<dim>       &body,
                                      const PeriodicChoice  &choice,
                                      const SecularSplit    &split,
                                      const SecularFlow     *flow,
                                      const FourierResult   *direct,
                                      const RelaxationTimes &relaxation_times,
                                      Log                   &log)
    : scene(scene)
    , body(body)
    , choice(choice)
    , split(split)
    , flow(flow)
    , direct(direct)
    , relaxation_times(relaxation_times)
    , log(log)
  {
  }



  template <int dim>
  PeriodicResult
  PeriodicSearch<dim>::run(
    Evolution<dim>                                  &evolution,
    PeriodMap<dim>                                  &period_map,
    StepList                                        &steps,
    const typename ObservedPeriods<dim>::SolveCount &n_solves,
    const std::vector<Observer *>                   &observers,
    RunState                                        &state,
    Leg                                             &leg) const
  {
    PeriodicResult shown = state.result;
    leg.ends_run         = true;
    const bool shows =
      choice.method == PeriodicMethodType::fourier && direct != nullptr;
    if (shows && state.methods_left == 0)
      {
        shown =
          show(evolution, steps, n_solves, observers, period_map.pauses());
        if (shown.converged)
          return shown;
        log.line("  anderson takes over");
        ++state.methods_left;
      }
    const unsigned int left_at_last = shows ? 2 : 1;

    Vector &viscous_strain = state.viscous_strain;
    if (direct != nullptr)
      viscous_strain = direct->motion.viscous_strain.front();
    else if (body.effects.viscosity.on && viscous_strain.size() == 0)
      body.points.initialize(viscous_strain, body.law.branches().size());
    const UnilateralBounds   bounds   = unilateral_bounds(body.lip, body.space);
    const MaterialState<dim> material = body.material.at(0.);
    const std::optional<ReturnDefect<dim>> defect =
      return_defect(material, bounds);
    const unsigned int   last = scene.periodic_state.maximum_periods;
    ObservedPeriods<dim> periods(period_map,
                                 n_solves,
                                 observers,
                                 std::min(last, leg.last_period),
                                 shown,
                                 !state.has_begun(),
                                 defect ? &*defect : nullptr);
    Ending               ending = Ending::stagnant;
    if (choice.method == PeriodicMethodType::march)
      ending = march(periods, viscous_strain);
    else if (state.methods_left < left_at_last)
      ending = accelerate(periods, viscous_strain);
    if (ending == Ending::stagnant && choice.may_fall_back)
      {
        if (state.methods_left < left_at_last)
          log.line("  anderson stagnates: march");
        state.methods_left = left_at_last;
        ending             = march(periods, viscous_strain);
      }
    PeriodicResult result = periods.result();
    result.converged      = ending == Ending::converged;
    leg.ends_run = result.converged || result.periods < leg.last_period ||
                   result.periods >= last;
    if (leg.ends_run)
      periods.finish(viscous_strain);
    else
      {
        // Without the observers: the next leg shows it as its beginning.
        period_map.finish(result.periods, viscous_strain, [](const Sample &) {
        });
        state.displacement = evolution.state().displacement;
      }
    return result;
  }



  template <int dim>
  PeriodicResult
  PeriodicSearch<dim>::show(
    Evolution<dim>                                  &evolution,
    StepList                                        &steps,
    const typename ObservedPeriods<dim>::SolveCount &n_solves,
    const std::vector<Observer *>                   &observers,
    Pauses                                          *pauses) const
  {
    constexpr double tolerable = 1e-8;
    FixedSteps       as_they_are;
    GivenMotion      motion(direct->motion,
                       direct->rule,
                       steps.step(0),
                       dealii::GridTools::diameter(body.space.mesh()),
                       largest_load(body, steps));
    PeriodMap<dim>   period_map(evolution, &motion, as_they_are, steps, pauses);

    std::vector<Observer *> all = observers;
    all.push_back(&motion);
    ObservedPeriods<dim> periods(period_map, n_solves, all, 1);
    Vector               r = direct->motion.viscous_strain.front();
    periods.compute(r);
    periods.finish(r);
    const double defect = motion.largest_defect();
    periods.report(defect);
    log.line("  direct in time: states and samples differ by " +
             Text::from_number(defect) + " at most");
    PeriodicResult result = periods.result();
    result.converged      = defect <= tolerable;
    if (!result.converged && !choice.may_fall_back)
      throw NumericalError(
        "[Periodic state] Method = fourier: the periodic motion that was found "
        "is not one: its states differ from those of the same viscous strain "
        "by " +
        Text::from_number(defect) +
        " of their size. Look for moduli or relaxation times that differ by "
        "many orders of magnitude, or use Method = anderson.");
    return result;
  }



  template <int dim>
  Ending
  PeriodicSearch<dim>::march(ObservedPeriods<dim> &periods, Vector &r) const
  {
    return March<dim>(periods, scene.periodic_state.tolerance, slowness())
      .run(r);
  }



  template <int dim>
  std::optional<ReturnDefect<dim>>
  PeriodicSearch<dim>::return_defect(const MaterialState<dim> &material,
                                     const UnilateralBounds   &bounds) const
  {
    const bool returns = body.effects.viscosity.on &&
                         (split.strain_returns || body.law.has_spring());
    // What bears no stress matters to a march where a lip may touch.
    if (!returns || (choice.method == PeriodicMethodType::march &&
                     !body.effects.contact.on))
      return {};
    return std::optional<ReturnDefect<dim>>(
      std::in_place,
      body.points,
      material,
      flow,
      split.is_split,
      relaxation_times.mean_fluidity_factor,
      scene.loads.period,
      bounds);
  }



  template <int dim>
  double
  PeriodicSearch<dim>::slowness() const
  {
    // Infinite where nothing relaxes; what does not relax does not change
    // either.
    const double slowest = relaxation_times.longest_in_mean;
    return std::isfinite(slowest)
             ? slowness_of_relaxation(scene.loads.period / slowest)
             : 1.;
  }



  template <int dim>
  Ending
  PeriodicSearch<dim>::accelerate(ObservedPeriods<dim> &periods,
                                  Vector               &r) const
  {
    const PeriodicStateParameters   &parameters = scene.periodic_state;
    const EnergyCoordinates<dim>     coordinates(body.space,
                                             body.points,
                                             body.material.at(0.));
    typename Anderson<dim>::Settings settings;
    settings.acceleration     = {parameters.anderson_depth,
                                 parameters.anderson_damping};
    settings.delay            = parameters.anderson_delay;
    settings.tolerance        = parameters.tolerance;
    settings.slowness         = slowness();
    settings.patience         = 2 * parameters.anderson_depth;
    settings.most_stagnations = std::numeric_limits<unsigned int>::max();
    if (choice.may_fall_back)
      {
        // Leaves most of the periods to what goes on.
        settings.patience =
          std::min(settings.patience, 1 + parameters.maximum_periods / 4);
        settings.most_stagnations = 0;
      }
    Anderson<dim> method(periods, coordinates, settings);
    const Ending  ending = method.run(r);
    if (const unsigned int n = method.n_restarts(); n > 0)
      log.line("  anderson began anew " +
               (n == 1 ? "once" : std::to_string(n) + " times") +
               ": residuals did not fall, or a step went astray");
    return ending;
  }



  template class PeriodicSearch<2>;
  template class PeriodicSearch<3>;
} // namespace Crevasse
