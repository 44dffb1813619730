// ---------------------------------------------------------------------
//
// Copyright (C) 2026 by the Crevasse authors
//
// This file is part of Crevasse. It is free software; you can use it,
// redistribute it and/or modify it under the terms of the GNU Lesser
// General Public License as published by the Free Software Foundation;
// either version 2.1 of the License, or (at your option) any later version.
//
// ---------------------------------------------------------------------

#include <crevasse/contact/relaxation_factor.h>
#include <crevasse/contact/unconstrained.h>
#include <crevasse/discretisation/node_blocks.h>
#include <crevasse/run/solvers.h>
#include <crevasse/scene/problems.h>
#include <crevasse/scene/text.h>

#include <deal.II/base/utilities.h>

#include <algorithm>
#include <utility>

namespace Crevasse
{
  using namespace dealii;

  namespace
  {
    template <int dim>
    SolverSettings
    make_settings(const Scene         &scene,
                  const Body<dim>     &body,
                  dealii::TimerOutput &phases)
    {
      const MPI_Comm           communicator = body.space.communicator();
      const LinearSolverChoice linear =
        choose_linear_solver(scene.linear_solver,
                             dim,
                             body.space.dof_handler().n_dofs(),
                             Utilities::MPI::n_mpi_processes(communicator));
      const std::size_t n_bounds =
        Utilities::MPI::sum(body.lip.nodes().size(), communicator);
      SolverSettings settings{scene.contact,
                              scene.linear_solver,
                              linear,
                              choose_contact_solver(scene.contact,
                                                    linear,
                                                    n_bounds),
                              phases,
                              {},
                              {}};
      const bool     sweeps = settings.contact_choice.name == "projected sor" ||
                          !scene.contact.relaxation_table.empty();
      if (sweeps && scene.contact.relaxed_together == "node")
        {
          require_one_rank(communicator);
          settings.unknown_blocks = node_blocks(body.space);
        }
      return settings;
    }



    /** The largest nodal force of the stress that thermal strain would cause
     * in a body that is held everywhere. */
    template <int dim>
    double
    largest_thermal_load(const Body<dim> &body, const double t)
    {
      const MaterialState<dim> material = body.material.at(t);
      Vector                   forces;
      body.strain_operator.initialize(forces);
      body.strain_operator.add_transpose(forces, [&](const std::size_t offset) {
        const std::size_t point = offset / n_stress_components<dim>;
        return material.stiffness_factor * ((*material.stiffness)[point] *
                                            (*material.thermal_strain)[point]);
      });
      return forces.linfty_norm();
    }
  } // namespace



  template <int dim>
  Solvers<dim>::Solvers(const Scene         &scene,
                        const Body<dim>     &body,
                        const StepList      &steps,
                        Log                 &log,
                        dealii::TimerOutput &phases)
    : scene(scene)
    , body(body)
    , log(log)
    , bounds(unilateral_bounds(body.lip))
    , solver_settings(make_settings(scene, body, phases))
  {
    solver_settings.relaxation_factor = [this, &steps](const SparseMatrix &A) {
      return relaxation_factor(A, steps);
    };
    solver_settings.largest_load = largest_load(steps);
    if (!body.material.stiffness_varies())
      {
        only_system =
          std::make_unique<ContactSystem<dim>>(solver_settings,
                                               body.space,
                                               body.points,
                                               *body.material.at(0.).stiffness,
                                               bounds);
        last_system = only_system.get();
      }
    log.line("  solver: " + current().contact_solver().description());
  }



  template <int dim>
  typename Solvers<dim>::Entry
  Solvers<dim>::make_entry(const double t)
  {
    Entry entry{body.material.at(t), nullptr};
    if (only_system == nullptr)
      {
        entry.system =
          std::make_unique<ContactSystem<dim>>(solver_settings,
                                               body.space,
                                               body.points,
                                               *entry.material.stiffness,
                                               bounds,
                                               last_system != nullptr
                                                 ? &last_system->stiffness()
                                                 : nullptr);
        if (last_system != nullptr)
          entry.system->contact_solver().start_from(
            last_system->contact_solver().closed_bounds());
      }
    return entry;
  }



  template <int dim>
  std::size_t
  Solvers<dim>::memory_consumption(const Entry &entry) const
  {
    std::size_t bytes =
      entry.system != nullptr ? entry.system->memory_consumption() : 0;
    if (body.material.stiffness_varies())
      bytes += entry.material.stiffness->memory_consumption();
    if (body.material.fluidity_varies())
      for (const auto &fluidity : entry.material.fluidity)
        bytes += fluidity->memory_consumption();
    if (body.material.thermal_strain_varies())
      bytes += entry.material.thermal_strain->memory_consumption();
    return bytes;
  }



  template <int dim>
  typename Solvers<dim>::Entry &
  Solvers<dim>::entry_at(const double t)
  {
    if (const auto found = kept.find(t); found != kept.end())
      return found->second;
    if (scratch && scratch_time == t)
      return *scratch;

    Entry             entry = make_entry(t);
    const std::size_t bytes =
      Utilities::MPI::sum(memory_consumption(entry), body.space.communicator());
    constexpr double mebibyte = 1024. * 1024.;
    if (!is_full && kept_bytes + bytes <=
                      scene.linear_solver.memory_for_instants * mebibyte)
      {
        kept_bytes += bytes;
        return kept.emplace(t, std::move(entry)).first->second;
      }
    if (!is_full)
      log.line("  memory: " + std::to_string(kept.size()) +
               " instants are kept; what varies in time is made anew for the "
               "others ([Linear solver] Memory for instants)");
    is_full = true;
    if (scratch && scratch->system != nullptr)
      of_the_past.add(scratch->system->statistics());
    scratch      = std::move(entry);
    scratch_time = t;
    return *scratch;
  }



  template <int dim>
  Instant<dim>
  Solvers<dim>::at(const double t)
  {
    const bool varies = body.material.stiffness_varies() ||
                        body.material.fluidity_varies() ||
                        body.material.thermal_strain_varies();
    // The only state of a material that does not vary is at t = 0.
    Entry &entry = entry_at(varies ? t : 0.);
    body.material.set_factors(t, entry.material);
    if (entry.system != nullptr)
      last_system = entry.system.get();
    return {entry.material, last_system->contact_solver()};
  }



  template <int dim>
  ContactSystem<dim> &
  Solvers<dim>::current()
  {
    if (last_system == nullptr)
      at(0.);
    return *last_system;
  }



  template <int dim>
  const SolverSettings &
  Solvers<dim>::settings() const
  {
    return solver_settings;
  }



  template <int dim>
  double
  Solvers<dim>::largest_load(const StepList &steps) const
  {
    // Between the samples too, where the stages of the integrators are.
    Vector loads;
    body.strain_operator.initialize(loads);
    double largest = 0.;
    for (unsigned int k = 0; k < steps.n_steps(); ++k)
      for (const double fraction : {0., 0.25, 0.5, 0.75})
        {
          body.loads.evaluate(steps.within_period(steps.instant(k) +
                                                  fraction * steps.step(k)),
                              loads);
          largest = std::max(largest, loads.linfty_norm());
        }
    if (body.material.has_thermal_strain())
      for (unsigned int k = 0; k < steps.n_steps(); ++k)
        largest =
          std::max(largest, largest_thermal_load(body, steps.instant(k)));
    if (largest != 0. && !(largest >= 1e-70 && largest <= 1e70))
      throw SceneError(
        "[Loads]: the largest force on a node over a period is " +
        Text::from_number(largest) +
        "; it must be from 1e-70 to 1e70. Choose other units.");
    return largest;
  }



  template <int dim>
  double
  Solvers<dim>::relaxation_factor(const SparseMatrix &matrix,
                                  const StepList     &steps)
  {
    if (scene.contact.relaxation_factor != "automatic")
      return Utilities::string_to_double(scene.contact.relaxation_factor);
    if (sor_factor)
      return *sor_factor;

    log.line("  searching for the relaxation factor of projected SOR");
    // As the paper does, without constraints; eight digits show the asymptotic
    // contraction.
    TimerOutput::Scope phase(solver_settings.phases, "relaxation factor");
    const Vector       loads =
      loads_at(body, steps.instant(step_of_largest_load(body, steps)));
    const double norm = loads.linfty_norm();
    sor_factor        = 1.; // nothing is loaded: any factor solves A q = 0
    if (norm > 0.)
      {
        const UnilateralBounds none;
        const SignoriniProblem unconstrained(matrix, none);
        sor_factor =
          find_relaxation_factor(unconstrained,
                                 *make_sweep(unconstrained,
                                             solver_settings.unknown_blocks),
                                 loads,
                                 1e-8 * norm,
                                 scene.contact.maximum_iterations);
      }
    return *sor_factor;
  }



  template <int dim>
  Vector
  Solvers<dim>::elastic_displacement(const Vector &loads, const bool lip_closed)
  {
    const UnilateralBounds none;
    std::vector<double>    no_forces;
    Vector                 displacement(loads);
    displacement = 0.;
    if (!lip_closed)
      {
        const SignoriniProblem unconstrained(current().stiffness(), none);
        Unconstrained(unconstrained,
                      current().linear_solver(),
                      scene.contact.tolerance)
          .solve(loads, displacement, no_forces);
        return displacement;
      }

    // A closed lip is a symmetry plane. The other space's constraints agree
    // with this one's but for the lip, where the loads then do not count.
    BoundaryRoles roles = body.space.roles();
    roles.symmetry.insert(roles.contact.begin(), roles.contact.end());
    roles.contact.clear();
    const Space<dim>   closed_space(body.space.shared_mesh(),
                                  body.space.finite_element().degree,
                                  roles,
                                  fixed_points<dim>(scene),
                                  body.space.volumetric_strain());
    ContactSystem<dim> closed(solver_settings,
                              closed_space,
                              body.points,
                              *body.material.at(0.).stiffness,
                              none);
    Vector             closed_loads(loads);
    closed_space.constraints().set_zero(closed_loads);
    closed.contact_solver().solve(closed_loads, displacement, no_forces);
    SolverStatistics statistics = closed.statistics();
    // It is no contact problem of the run.
    statistics.vi_solves = statistics.vi_iterations = 0;
    of_the_past.add(statistics);
    return displacement;
  }



  template <int dim>
  SolverStatistics
  Solvers<dim>::statistics() const
  {
    SolverStatistics all = of_the_past;
    if (only_system != nullptr)
      all.add(only_system->statistics());
    for (const auto &[t, entry] : kept)
      if (entry.system != nullptr)
        all.add(entry.system->statistics());
    if (scratch && scratch->system != nullptr)
      all.add(scratch->system->statistics());
    return all;
  }



  template <int dim>
  void
  Solvers<dim>::add(const SolverStatistics &other)
  {
    of_the_past.add(other);
  }



  template <int dim>
  void
  Solvers<dim>::summarise(Summary &summary) const
  {
    if (last_system != nullptr)
      last_system->describe(summary);
    statistics().add_to(summary);
  }



  template <int dim>
  Vector
  loads_at(const Body<dim> &body, const double t)
  {
    Vector loads;
    body.strain_operator.initialize(loads);
    body.loads.evaluate(t, loads);
    return loads;
  }



  template <int dim>
  unsigned int
  step_of_largest_load(const Body<dim> &body, const StepList &steps)
  {
    unsigned int largest = 0;
    double       norm    = -1.;
    for (unsigned int k = 0; k < steps.n_steps(); ++k)
      {
        const double here = loads_at(body, steps.instant(k)).l2_norm();
        if (here > norm)
          {
            norm    = here;
            largest = k;
          }
      }
    return largest;
  }



  template class Solvers<2>;
  template class Solvers<3>;
  template Vector
  loads_at<2>(const Body<2> &, const double);
  template Vector
  loads_at<3>(const Body<3> &, const double);
  template unsigned int
  step_of_largest_load<2>(const Body<2> &, const StepList &);
  template unsigned int
  step_of_largest_load<3>(const Body<3> &, const StepList &);
} // namespace Crevasse
