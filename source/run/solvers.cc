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
#include <crevasse/discretisation/node_blocks.h>
#include <crevasse/run/largest_load.h>
#include <crevasse/run/solvers.h>

#include <deal.II/base/utilities.h>


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
    , instants(body,
               1024. * 1024. * scene.linear_solver.memory_for_instants,
               log)
  {
    solver_settings.relaxation_factor = [this, &steps](const SparseMatrix &A) {
      if (!sor_factor)
        sor_factor = relaxation_factor(
          A,
          loads_at(this->body,
                   steps.instant(step_of_largest_load(this->body, steps))));
      return *sor_factor;
    };
    solver_settings.largest_load = largest_load(body, steps);
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
  InstantEntry<dim>
  Solvers<dim>::make_entry(const double t)
  {
    InstantEntry<dim> entry{body.material.at(t), nullptr};
    if (only_system == nullptr)
      {
        entry.system =
          std::make_unique<ContactSystem<dim>>(solver_settings,
                                               body.space,
                                               body.points,
                                               *entry.material.stiffness,
                                               bounds,
                                               last_system);
        if (last_system != nullptr)
          entry.system->contact_solver().start_from(
            last_system->contact_solver().closed_bounds());
      }
    return entry;
  }



  template <int dim>
  Instant<dim>
  Solvers<dim>::at(const double t)
  {
    const bool varies = body.material.stiffness_varies() ||
                        body.material.fluidity_varies() ||
                        body.material.thermal_strain_varies();
    // The only state of a material that does not vary is at t = 0.
    InstantEntry<dim> &entry =
      instants.at(varies ? t : 0., [&]() { return make_entry(t); });
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
  Solvers<dim>::relaxation_factor(const SparseMatrix &matrix,
                                  const Vector       &loads) const
  {
    if (scene.contact.relaxation_factor != "automatic")
      return Utilities::string_to_double(scene.contact.relaxation_factor);
    const double norm = loads.linfty_norm();
    if (norm == 0.)
      return 1.; // any factor solves A q = 0

    log.line("  searching for the relaxation factor of projected SOR");
    // As the paper does, without constraints; eight digits show the asymptotic
    // contraction.
    TimerOutput::Scope     phase(solver_settings.phases, "relaxation factor");
    const UnilateralBounds none;
    const SignoriniProblem unconstrained(matrix, none);
    return find_relaxation_factor(unconstrained,
                                  *make_sweep(unconstrained,
                                              solver_settings.unknown_blocks),
                                  loads,
                                  1e-8 * norm,
                                  scene.contact.maximum_iterations);
  }



  template <int dim>
  SolverStatistics
  Solvers<dim>::statistics() const
  {
    SolverStatistics all = of_the_past;
    if (only_system != nullptr)
      all.add(only_system->statistics());
    all.add(instants.statistics());
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



  template class Solvers<2>;
  template class Solvers<3>;
} // namespace Crevasse
