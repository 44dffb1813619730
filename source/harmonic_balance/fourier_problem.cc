// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/problems.h>
#include <crevasse/base/text.h>
#include <crevasse/harmonic_balance/fourier.h>
#include <crevasse/secular/secular_problem.h>
#include <crevasse/secular/viscosity.h>

namespace Crevasse
{
  using namespace dealii;

  namespace
  {
    /** Reasons in the material against harmonic balance, with advice. */
    template <int dim>
    std::vector<std::string>
    material_obstacles(const Body<dim> &body)
    {
      const std::string instead = "; use [Periodic state] Method = anderson";
      const Effects    &effects = body.effects;
      if (!effects.viscosity.on)
        return {
          "without viscosity each instant is a problem of its own; use "
          "[Periodic state] Method = march"};
      std::vector<std::string> found;
      if (effects.varying_stiffness.on)
        found.push_back("the stiffness varies in time, " +
                        effects.varying_stiffness.why + instead);
      if (body.material.fluidity_varies)
        found.push_back("the viscosity varies in time, " +
                        effects.varying_viscosity.why +
                        "; use [Periodic state] Method = march");
      else if (effects.varying_viscosity.on)
        found.push_back("the viscosity varies in time, " +
                        effects.varying_viscosity.why + instead);
      if (body.law.creep != nullptr)
        found.emplace_back(
          "nonlinear creep couples the harmonics; use [Periodic state] "
          "Method = march");
      if (!found.empty())
        return found;
      if (!body.law.has_spring() && !has_viscosity(body))
        found.emplace_back(
          "the fluidity of [Material] is singular: a part of the strain does "
          "not flow; use [Periodic state] Method = march");
      return found;
    }



    std::vector<std::string>
    warnings_about(const PeriodicMotion &motion,
                   const double          step,
                   const double          smallest_relaxation_time)
    {
      constexpr unsigned int   enough = 5;
      std::vector<std::string> warnings;
      if (step > 2. * smallest_relaxation_time)
        warnings.push_back(
          "the steps of " + Text::from_number(step, 5) +
          " are longer than twice the smallest relaxation time, " +
          Text::from_number(smallest_relaxation_time, 5) +
          ": the fastest relaxation is not resolved. Raise [Time integration] "
          "Steps per period.");
      const auto &counts = motion.instants_of_contact;
      const auto  n_poor =
        std::count_if(counts.begin(), counts.end(), [](const unsigned int n) {
          return n < enough;
        });
      if (n_poor > 0)
        warnings.push_back(
          std::to_string(n_poor) + " of " + std::to_string(counts.size()) +
          " nodes of the lip that bear a mean force are closed at fewer than " +
          std::to_string(enough) + " instants, the fewest at " +
          std::to_string(*std::min_element(counts.begin(), counts.end())) +
          ": their forces are not resolved. Raise [Time integration] Steps per "
          "period.");
      return warnings;
    }



    /** Solves on the first rank, for all: ranks must proceed alike. */
    PeriodicContactSolution
    solve_contact(const PeriodicContactProblem &problem,
                  const MPI_Comm                communicator,
                  FourierResult                &result)
    {
      PeriodicContactSolution solution;
      collectively(communicator, [&]() {
        if (Utilities::MPI::this_mpi_process(communicator) != 0)
          return;
        solution       = solve_periodic_contact(problem);
        result.contact = solution.describe();
      });
      const auto report = [communicator](auto &value) {
        value = Utilities::MPI::broadcast(communicator, value, 0);
      };
      report(solution.forces);
      report(solution.offsets);
      report(result.contact);
      return solution;
    }
  } // namespace



  std::string
  FourierResult::describe() const
  {
    const std::string counts = "  harmonic balance, loaded harmonics: " +
                               std::to_string(motion.loaded_harmonics) +
                               ", complex factorisations: " +
                               std::to_string(motion.complex_factorisations);
    return contact.empty()
             ? counts
             : counts + "\n  periodic contact at " +
                 std::to_string(motion.instants_of_contact.size()) +
                 " nodes: " + contact;
  }



  void
  FourierResult::add_to(Summary &summary) const
  {
    auto &own                     = summary["harmonic_balance"];
    own["loaded_harmonics"]       = motion.loaded_harmonics;
    own["complex_factorisations"] = motion.complex_factorisations;
    own["nodes_with_mean_force"]  = motion.instants_of_contact.size();
    own["contact"]                = contact;
  }



  template <int dim>
  std::vector<std::string>
  fourier_obstacles(const Scene     &scene,
                    const Body<dim> &body,
                    const StepList  &steps)
  {
    std::vector<std::string> all = material_obstacles(body);
    if (!body.held_by_contact.empty())
      all.push_back(what_contact_holds(body.held_by_contact) +
                    "; use [Periodic state] Method = march");
    if (scene.time_integration.step_control != StepControlType::uniform)
      all.emplace_back(
        "harmonics need equal steps; set [Time integration] Step control = "
        "uniform, or use [Periodic state] Method = anderson");
    else if (!steps.are_equal())
      all.emplace_back(
        "harmonics need equal steps, but rows of a table that force the end of "
        "a step divide them; use [Periodic state] Method = anderson");
    for (unsigned int k = 1; k <= steps.n_steps(); ++k)
      if (steps.jumps_at(steps.instant(k)))
        {
          all.push_back("loads or temperatures jump at t = " +
                        Text::from_number(steps.instant(k)) +
                        ", where harmonic balance would need two values; use "
                        "[Periodic state] Method = anderson");
          break;
        }
    return all;
  }



  template <int dim>
  void
  require_fourier(const Scene     &scene,
                  const Body<dim> &body,
                  const StepList  &steps)
  {
    Problems problems;
    for (const std::string &obstacle : fourier_obstacles(scene, body, steps))
      problems.add("[Periodic state] Method = fourier: " + obstacle + ".");
    problems.throw_if_any();
  }



  template <int dim>
  FourierResult
  solve_fourier_problem(const Scene             &scene,
                        const Body<dim>         &body,
                        const StepList          &steps,
                        ContactSystemCache<dim> &systems,
                        const double             smallest_relaxation_time)
  {
    FourierResult result;
    result.rule = scene.periodic_state.harmonics;
    const Harmonics    harmonics(steps.period(), steps.n_steps(), result.rule);
    const Fourier<dim> fourier(body,
                               harmonics,
                               systems.system_at(0.).linear_solver());

    const Vector mean_load = fourier.mean_load();
    if (!body.law.has_spring() &&
        (mean_load.linfty_norm() > fourier.negligible_load() ||
         body.imposed.flows))
      {
        const Stopwatch phase("secular problem");
        result.flow = solve_secular_problem(body, mean_load, systems);
      }
    const Stopwatch phase("harmonics");
    result.motion = fourier.solve(
      result.flow ? &*result.flow : nullptr,
      [&](const PeriodicContactProblem &problem) {
        const Stopwatch phase("periodic contact");
        return solve_contact(problem, body.space.communicator(), result);
      },
      1024. * 1024. * scene.linear_solver.memory_for_instants);
    result.warnings = warnings_about(result.motion,
                                     steps.largest_step(),
                                     smallest_relaxation_time);
    return result;
  }



  template decltype(fourier_obstacles<2>)     fourier_obstacles<2>;
  template decltype(fourier_obstacles<3>)     fourier_obstacles<3>;
  template decltype(require_fourier<2>)       require_fourier<2>;
  template decltype(require_fourier<3>)       require_fourier<3>;
  template decltype(solve_fourier_problem<2>) solve_fourier_problem<2>;
  template decltype(solve_fourier_problem<3>) solve_fourier_problem<3>;
} // namespace Crevasse
