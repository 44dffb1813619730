// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/problems.h>
#include <crevasse/secular/secular_problem.h>
#include <crevasse/secular/viscosity.h>
#include <crevasse/time/stages.h>

#include <sstream>

namespace Crevasse
{
  using namespace dealii;

  namespace
  {
    constexpr double rounding_of_means = 1e-12;



    /** Scale of the loads whose mean is the mean load. */
    template <int dim>
    double
    largest_weighted_load(const Body<dim> &body, const double period)
    {
      constexpr unsigned int n_samples = 512;
      Vector                 loads;
      body.strain_operator.initialize(loads);
      double largest = 0.;
      for (unsigned int k = 0; k < n_samples; ++k)
        {
          const double t = period * (k + 0.5) / n_samples;
          body.loads.evaluate(t, loads);
          largest =
            std::max(largest,
                     loads.linfty_norm() / body.law.viscosity_factor(t));
        }
      return largest;
    }



    /** Mean load f̄ by the quadrature rule of an integrator's steps. */
    template <int dim>
    Vector
    mean_load_of_steps(const Body<dim>  &body,
                       const StepList   &steps,
                       const Integrator &integrator)
    {
      const Stages stages(steps, integrator.properties.quadrature);
      Vector       mean, loads;
      body.strain_operator.initialize(mean);
      body.strain_operator.initialize(loads);
      for (unsigned int j = 0; j < stages.instants.size(); ++j)
        {
          const double t = stages.instants[j];
          body.loads.evaluate(t, loads);
          mean.add(stages.weights[j] / steps.period() /
                     body.law.viscosity_factor(t),
                   loads);
        }
      return mean;
    }



    constexpr const char *advice_on_steps =
      "Loads or viscosity change within a step. Use more steps, or [Time "
      "integration] Step control = list with the instants of the changes.";



    /** Warning if the mean load of the steps is wrong, or empty.
     *
     * @param missed_load difference of the mean loads.
     * @param seen mean load by the steps. */
    std::string
    warning_of_steps(const Vector &mean_load,
                     const Vector &seen,
                     const double  missed_load,
                     const double  largest_load,
                     const bool    flows)
    {
      constexpr double hardly_any = 1e-3;
      if (!flows)
        return seen.linfty_norm() <= 0.01 * largest_load
                 ? ""
                 : "the mean load vanishes, but its samples at the time steps "
                   "do not: the secular flow is an error of the steps. " +
                     std::string(advice_on_steps);
      const double mean = mean_load.linfty_norm();
      const double part = missed_load / mean;
      if (part <= 0.1) // typical error of coarse Euler steps
        return "";
      std::ostringstream text;
      text << "the mean load over the period and the mean of its samples at "
              "the time steps differ by "
           << 100. * part << " %, and so do beta and the flow of the march. "
           << advice_on_steps;
      if (mean <= hardly_any * largest_load)
        text << " If the mean load should vanish (it is " << mean / largest_load
             << " of the largest load), write pi in formulas instead of a "
                "number with few digits.";
      return text.str();
    }



    /** Warning of steps with negative weights in the mean over the period, or
     * empty. */
    std::string
    warning_of_negative_weights(const std::string &scheme,
                                const Integrator  &integrator)
    {
      const std::vector<double> &weights =
        integrator.properties.quadrature.weights;
      if (std::none_of(weights.begin(), weights.end(), [](const double weight) {
            return weight < 0.;
          }))
        return "";
      return "[Time integration] Scheme = " + scheme +
             " of this Order has stages of negative weight: where the lip "
             "opens in the mean, pressures of its stages may cancel, and the "
             "periodic state is determined only up to the error of the steps. "
             "Set Order = 2, or Scheme = sdirk2.";
    }



    std::string
    setting_of(const SecularSplitType wish)
    {
      return "[Periodic state] Secular split = " + name_of(wish);
    }



    /** Computes the mean load of the steps, and uses it for the split.
     *
     * @param largest scale of the loads.
     * @throw SceneError if the steps miss the flow that is split off. */
    template <int dim>
    void
    compare_with_steps(const Scene      &scene,
                       const Body<dim>  &body,
                       const StepList   &steps,
                       const Integrator &integrator,
                       const double      largest,
                       SecularSplit     &split)
    {
      const bool has_weights =
        !integrator.properties.quadrature.weights.empty();
      const Vector seen        = mean_load_of_steps(body, steps, integrator);
      Vector       missed_part = seen;
      missed_part -= split.mean_load;
      const double missed_load = missed_part.linfty_norm();
      split.strain_returns =
        has_weights && !scene.time_integration.locate_contact_events &&
        (split.is_split || missed_load <= 10. * rounding_of_means * largest);
      const std::string warning =
        warning_of_steps(split.mean_load,
                         seen,
                         missed_load,
                         largest,
                         split.mean_load.linfty_norm() >
                           rounding_of_means * largest);
      if (!warning.empty() && split.is_split)
        throw SceneError(setting_of(scene.periodic_state.secular_split) + ": " +
                         warning);
      if (!warning.empty())
        split.warning = "[Periodic state] Secular split: " + warning;
      else if (split.is_split && body.effects.contact.on)
        split.warning = warning_of_negative_weights(
          traits(scene.time_integration.scheme).name, integrator);
      // The marched motion must not drift by the error of the steps.
      if (split.is_split && has_weights)
        split.mean_load = seen;
    }



    /** Relaxation time τ of a body whose viscosity is τK everywhere: then A
     * also solves the secular problem. None for other bodies. Collective. */
    template <int dim>
    std::optional<double>
    uniform_relaxation_time(const Body<dim>          &body,
                            const Viscosity<dim>     &viscosity,
                            const MaterialState<dim> &material)
    {
      const auto       &eta          = viscosity.sum;
      const auto       &K            = *material.stiffness;
      const std::size_t n_points     = body.points.n_local_points;
      const MPI_Comm    communicator = body.space.communicator();

      const double tau =
        Utilities::MPI::max(n_points > 0 ? eta[0].norm() / K[0].norm() : 0.,
                            communicator);
      bool is_uniform = true;
      for (std::size_t p = 0; p < n_points && is_uniform; ++p)
        is_uniform =
          (eta[p] - tau * K[p]).norm() <= rounding_of_means * tau * K[p].norm();
      if (Utilities::MPI::min(is_uniform ? 1 : 0, communicator) == 0)
        return {};
      return tau;
    }
  } // namespace



  template <int dim>
  std::string
  secular_obstacle(const Body<dim> &body)
  {
    if (!body.effects.viscosity.on)
      return "without viscosity nothing flows";
    if (body.friction)
      return "with friction the flow depends on how the lips slide";
    if (body.law.has_spring())
      return "the elastic spring of the chain bears the mean load";
    if (body.law.creep != nullptr)
      return "the mean of nonlinear creep is not the creep under the mean "
             "load";
    if (body.material.fluidity_varies)
      return "the viscosity varies in time, and not by [Material] Viscosity "
             "time factor alone";
    if (!has_viscosity(body))
      return "the fluidity is singular: a part of the strain does not flow";
    return "";
  }



  template <int dim>
  SecularSplit
  choose_secular_split(const Scene      &scene,
                       const Body<dim>  &body,
                       const StepList   &steps,
                       const Integrator *integrator,
                       const bool        needs_periodic_strain)
  {
    SecularSplit split;
    split.effect                   = body.effects.secular_flow;
    Effects::Effect       &effect  = split.effect;
    const SecularSplitType wish    = scene.periodic_state.secular_split;
    const std::string      setting = setting_of(wish);
    if (body.imposed.flows)
      {
        const std::string obstacle =
          wish == SecularSplitType::off ? setting : secular_obstacle(body);
        if (!obstacle.empty())
          throw SceneError(
            "[Loads] Displacement rate: there is no secular flow to take it (" +
            obstacle + "). Leave it empty.");
      }
    if (wish == SecularSplitType::off)
      {
        effect.why = setting + ": the displacement contains the flow";
        return split;
      }
    const std::string reason = secular_obstacle(body);
    if (!reason.empty())
      {
        if (wish == SecularSplitType::on)
          throw SceneError(setting + ": " + reason +
                           ". Set it to automatic or off.");
        effect.why = reason;
        return split;
      }
    body.strain_operator.initialize(split.mean_load);
    body.loads.mean([&](
                      const double t) { return body.law.viscosity_factor(t); },
                    scene.loads.period,
                    split.mean_load);
    const double largest = largest_weighted_load(body, scene.loads.period);
    const bool   has_mean =
      split.mean_load.linfty_norm() > rounding_of_means * largest;
    const bool is_imposed = body.imposed.flows;
    effect.on             = has_mean || is_imposed;
    split.is_split =
      is_imposed ||
      (effect.on && (wish == SecularSplitType::on || needs_periodic_strain));
    effect.why =
      is_imposed   ? "[Loads] Displacement rate is not 0: its flow is split off"
      : !effect.on ? "the mean load vanishes"
      : split.is_split
        ? "the mean load does not vanish: its flow is split off"
        : "the mean load does not vanish: beta is computed, not split off";
    const auto &scheme = traits(scene.time_integration.scheme);
    if (split.is_split && !scheme.has(Trait::flows_by_mean_load))
      throw SceneError(
        std::string("[Time integration] Scheme = ") + scheme.name +
        " with [Periodic state] " +
        std::string(wish == SecularSplitType::on
                      ? "Secular split = on"
                      : "Method = " + name_of(scene.periodic_state.method)) +
        ": the steady flow of its steps is not the beta of the secular "
        "problem, and contact would depend on the difference. Use Method = "
        "march with Secular split = automatic, or another scheme, such as "
        "sdirk2.");
    // Adaptive steps resolve the loads.
    if (scene.time_integration.step_control == StepControlType::adaptive)
      return split;
    compare_with_steps(scene, body, steps, *integrator, largest, split);
    return split;
  }



  template <int dim>
  SecularFlow
  solve_secular_problem(const Body<dim>         &body,
                        const Vector            &mean_load,
                        ContactSystemCache<dim> &systems)
  {
    const MaterialState<dim> material = body.material.at(0.);
    const Viscosity<dim>     viscosity(body, material);

    // The matrix of the solver is ∫ Dᵀ η D / time.
    UnilateralBounds bounds =
      unilateral_bounds(body.lip, body.space, body.held_by_contact);
    Vector load = mean_load;
    if (body.imposed.flows)
      {
        Vector imposed(mean_load);
        imposed = 0.;
        body.strain_operator.add_transpose(
          imposed, [&](const std::size_t offset) {
            const std::size_t point = offset / n_stress_components<dim>;
            return viscosity.sum[point] * viscosity.imposed_rate[point];
          });
        load -= imposed;
      }
    double                              time = 1., factor = 1.;
    ContactSolver                      *contact_solver;
    SolverSettings                      settings = systems.settings;
    std::unique_ptr<ContactSystem<dim>> own;
    if (const auto tau = uniform_relaxation_time(body, viscosity, material);
        tau && !body.lip.has_gap)
      {
        // The mean contains the viscosity and may have any size: scale it to
        // the loads, by which that solver measures errors.
        time = *tau;
        if (load.linfty_norm() > 0.)
          factor = settings.largest_load / load.linfty_norm();
        load *= factor;
        contact_solver = &systems.at(0.).contact_solver;
      }
    else
      {
        settings.relaxation_factor = [&](const SparseMatrix &matrix) {
          return systems.relaxation_factor(matrix, load);
        };
        std::fill(bounds.gap.begin(), bounds.gap.end(), 0.);
        own            = std::make_unique<ContactSystem<dim>>(settings,
                                                   body.space,
                                                   body.points,
                                                   viscosity.sum,
                                                   bounds,
                                                   &systems.system_at(0.));
        contact_solver = &own->contact_solver();
        contact_solver->set_force_scale(load.linfty_norm());
      }

    SecularFlow flow;
    body.strain_operator.initialize(flow.velocity);
    contact_solver->solve(load, flow.velocity, flow.contact_forces.normal);
    flow.velocity /= time * factor;
    viscosity.set_strain_rates(body, material, flow);
    for (double &force : flow.contact_forces.normal)
      force *= material.viscosity_factor / factor;
    if (own != nullptr)
      systems.add(own->statistics());
    return flow;
  }



  template decltype(secular_obstacle<2>)      secular_obstacle<2>;
  template decltype(secular_obstacle<3>)      secular_obstacle<3>;
  template decltype(choose_secular_split<2>)  choose_secular_split<2>;
  template decltype(choose_secular_split<3>)  choose_secular_split<3>;
  template decltype(solve_secular_problem<2>) solve_secular_problem<2>;
  template decltype(solve_secular_problem<3>) solve_secular_problem<3>;
} // namespace Crevasse
