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

#include <crevasse/contact/active_set.h>
#include <crevasse/contact/condensed_active_set.h>
#include <crevasse/contact/projected_sor.h>
#include <crevasse/contact/relaxation_factor.h>
#include <crevasse/contact/unconstrained.h>
#include <crevasse/discretisation/node_blocks.h>
#include <crevasse/discretisation/rigid_modes.h>
#include <crevasse/discretisation/stiffness.h>
#include <crevasse/linear/amg_cg.h>
#include <crevasse/linear/cholesky.h>
#include <crevasse/linear/mumps.h>
#include <crevasse/run/solvers.h>

#include <deal.II/base/utilities.h>

#include <algorithm>
#include <utility>

namespace Crevasse
{
  using namespace dealii;

  template <int dim>
  Solvers<dim>::Solvers(const Scene         &scene,
                        const Body<dim>     &body,
                        const StepList      &steps,
                        Log                 &log,
                        dealii::TimerOutput &phases)
    : scene(scene)
    , body(body)
    , log(log)
    , phases(phases)
    , linear_choice(choose_linear_solver(scene.linear_solver,
                                         dim,
                                         body.space.dof_handler().n_dofs(),
                                         Utilities::MPI::n_mpi_processes(
                                           body.space.communicator())))
    , contact_choice(
        choose_contact_solver(scene.contact,
                              linear_choice,
                              Utilities::MPI::sum(body.lip.nodes().size(),
                                                  body.space.communicator())))
    , bounds(unilateral_bounds(body.lip))
  {
    {
      TimerOutput::Scope phase(phases, "assembly");
      assemble_stiffness(body.space, body.law.stiffness(), matrix);
      ++count.assemblies;
    }
    problem           = std::make_unique<SignoriniProblem>(matrix, bounds);
    const bool sweeps = contact_choice.name == "projected sor" ||
                        !scene.contact.relaxation_table.empty();
    if (sweeps && scene.contact.relaxed_together == "node")
      {
        require_one_rank(body.space.communicator());
        unknown_blocks = node_blocks(body.space);
      }

    contact = make_contact_solver(steps);
    contact->judge_by_load(largest_load(steps));
    log.line("  solver: " + contact->description());
  }



  template <int dim>
  std::unique_ptr<ContactSolver>
  Solvers<dim>::make_contact_solver(const StepList &steps)
  {
    const ContactParameters &parameters = scene.contact;
    if (problem->n_bounds() == 0)
      return std::make_unique<Unconstrained>(*problem,
                                             linear_solver(),
                                             parameters.tolerance);
    if (contact_choice.name == "projected sor")
      {
        auto sweep = make_sweep(*problem, unknown_blocks);
        return std::make_unique<ProjectedSor>(*problem,
                                              std::move(sweep),
                                              relaxation_factor(steps),
                                              parameters.tolerance,
                                              parameters.maximum_iterations);
      }
    if (contact_choice.name == "active set")
      return std::make_unique<ActiveSet>(*problem,
                                         linear_solver(),
                                         parameters.tolerance,
                                         scene.linear_solver.tolerance,
                                         parameters.maximum_iterations);
    return std::make_unique<CondensedActiveSet>(*problem,
                                                linear_solver(),
                                                parameters.tolerance);
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
    return largest;
  }



  template <int dim>
  double
  Solvers<dim>::relaxation_factor(const StepList &steps)
  {
    if (scene.contact.relaxation_factor != "automatic")
      return Utilities::string_to_double(scene.contact.relaxation_factor);

    log.line("  searching for the relaxation factor of projected SOR");
    // As the paper does, without constraints; eight digits show the asymptotic
    // contraction.
    TimerOutput::Scope phase(phases, "relaxation factor");
    const Vector       loads =
      loads_at(body, steps.instant(step_of_largest_load(body, steps)));
    const double norm = loads.linfty_norm();
    if (norm == 0.)
      return 1.; // nothing is loaded: any factor solves A q = 0
    const UnilateralBounds none;
    const SignoriniProblem unconstrained(matrix, none);
    return find_relaxation_factor(unconstrained,
                                  *make_sweep(unconstrained, unknown_blocks),
                                  loads,
                                  1e-8 * norm,
                                  scene.contact.maximum_iterations);
  }



  template <int dim>
  std::unique_ptr<LinearSolver>
  Solvers<dim>::make_linear_solver(const SparseMatrix &matrix,
                                   const Space<dim>   &space)
  {
    if (linear_choice.type == LinearSolverChoice::amg)
      {
        TimerOutput::Scope phase(phases, "multigrid set-up");
        ++count.multigrid_setups;
        return std::make_unique<AmgCg>(matrix,
                                       rigid_modes(space),
                                       dim,
                                       space.finite_element().degree > 1);
      }
    TimerOutput::Scope phase(phases, "factorisation");
    ++count.factorisations;
    if (linear_choice.type == LinearSolverChoice::mumps)
      return std::make_unique<Mumps>(matrix);
    return std::make_unique<Cholesky>(matrix);
  }



  template <int dim>
  ContactSolver &
  Solvers<dim>::contact_solver()
  {
    return *contact;
  }



  template <int dim>
  const SignoriniProblem &
  Solvers<dim>::contact_problem() const
  {
    return *problem;
  }



  template <int dim>
  const SparseMatrix &
  Solvers<dim>::stiffness() const
  {
    return matrix;
  }



  template <int dim>
  const UnknownBlocks &
  Solvers<dim>::blocks() const
  {
    return unknown_blocks;
  }



  template <int dim>
  LinearSolver &
  Solvers<dim>::linear_solver()
  {
    if (open_solver == nullptr)
      open_solver = make_linear_solver(matrix, body.space);
    return *open_solver;
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
        const SignoriniProblem unconstrained(matrix, none);
        Unconstrained(unconstrained, linear_solver(), scene.contact.tolerance)
          .solve(loads, displacement, no_forces);
        return displacement;
      }

    // A closed lip is a symmetry plane. The other space's constraints agree
    // with this one's but for the lip, where the loads then do not count.
    BoundaryRoles roles = body.space.roles();
    roles.symmetry.insert(roles.contact.begin(), roles.contact.end());
    roles.contact.clear();
    const Space<dim> closed_space(body.space.shared_mesh(),
                                  body.space.finite_element().degree,
                                  roles,
                                  fixed_points<dim>(scene),
                                  body.space.volumetric_strain());
    assemble_stiffness(closed_space, body.law.stiffness(), closed_matrix);
    ++count.assemblies;

    Vector closed_loads(loads);
    closed_space.constraints().set_zero(closed_loads);
    closed_solver = make_linear_solver(closed_matrix, closed_space);
    const SignoriniProblem unconstrained(closed_matrix, none);
    Unconstrained(unconstrained, *closed_solver, scene.contact.tolerance)
      .solve(closed_loads, displacement, no_forces);
    return displacement;
  }



  template <int dim>
  template <typename Number>
  Number
  Solvers<dim>::total(Number (LinearSolver::*number)() const) const
  {
    return (open_solver != nullptr ? (*open_solver.*number)() : Number()) +
           (closed_solver != nullptr ? (*closed_solver.*number)() : Number());
  }



  template <int dim>
  void
  Solvers<dim>::summarise(Summary &summary) const
  {
    summary["contact_solver"] = {{"name", contact_choice.name},
                                 {"why", contact_choice.why},
                                 {"description", contact->description()}};
    if (problem->n_bounds() == 0)
      summary["contact_solver"] = {{"name", "none"},
                                   {"why", "there is no contact"},
                                   {"description", contact->description()}};
    if (open_solver != nullptr)
      summary["linear_solver"] = {{"why", linear_choice.why},
                                  {"description", open_solver->description()}};

    const std::size_t n_solves   = total(&LinearSolver::n_solves);
    auto             &counters   = summary["counters"];
    counters["assemblies"]       = count.assemblies;
    counters["factorisations"]   = count.factorisations;
    counters["multigrid_setups"] = count.multigrid_setups;
    counters["linear_solves"]    = n_solves + contact->n_linear_solves();
    counters["linear_iterations"] =
      total(&LinearSolver::n_iterations) + contact->n_linear_iterations();
    counters["vi_solves"]     = contact->n_solves();
    counters["vi_iterations"] = contact->n_iterations();

    const Certificate &worst = contact->worst_certificate();
    summary["certificate"]   = {{"penetration", worst.penetration},
                                {"tension", worst.tension},
                                {"complementarity", worst.complementarity},
                                {"residual", worst.residual}};
    if (contact->n_solves() > 0)
      summary["seconds"]["vi_mean"] = contact->seconds() / contact->n_solves();
    if (n_solves > 0)
      summary["seconds"]["back_solve_mean"] =
        total(&LinearSolver::seconds) / n_solves;
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
