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

#include <crevasse/contact/condensed_active_set.h>
#include <crevasse/contact/projected_sor.h>
#include <crevasse/contact/relaxation_factor.h>
#include <crevasse/contact/unconstrained.h>
#include <crevasse/discretisation/stiffness.h>
#include <crevasse/linear/cholesky.h>
#include <crevasse/run/solvers.h>

#include <deal.II/base/utilities.h>

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
    , phases(phases)
    , bounds(unilateral_bounds(body.lip))
  {
    {
      TimerOutput::Scope phase(phases, "assembly");
      assemble_stiffness(body.space, body.law.stiffness(), matrix);
      ++count.assemblies;
    }
    problem = std::make_unique<SignoriniProblem>(matrix, bounds);

    contact = make_contact_solver(steps);
    log.line("  solver: " + contact->description());
  }



  template <int dim>
  std::unique_ptr<ContactSolver>
  Solvers<dim>::make_contact_solver(const StepList &steps)
  {
    const ContactParameters &parameters = scene.contact;
    if (problem->n_bounds() == 0)
      return std::make_unique<Unconstrained>(*problem,
                                             direct_solver(),
                                             parameters.tolerance);
    if (parameters.solver == "projected sor")
      return std::make_unique<ProjectedSor>(*problem,
                                            relaxation_factor(steps),
                                            parameters.tolerance,
                                            parameters.maximum_iterations);
    return std::make_unique<CondensedActiveSet>(*problem,
                                                direct_solver(),
                                                parameters.tolerance);
  }



  template <int dim>
  double
  Solvers<dim>::relaxation_factor(const StepList &steps)
  {
    if (scene.contact.relaxation_factor != "automatic")
      return Utilities::string_to_double(scene.contact.relaxation_factor);

    // As the paper does, without constraints; eight digits show the asymptotic
    // contraction.
    TimerOutput::Scope phase(phases, "relaxation factor");
    const Vector       loads =
      loads_at(body, steps.instant(step_of_largest_load(body, steps)));
    const double norm = loads.linfty_norm();
    if (norm == 0.)
      return 1.; // nothing is loaded: any factor solves A q = 0
    const UnilateralBounds none;
    return find_relaxation_factor(SignoriniProblem(matrix, none),
                                  loads,
                                  1e-8 * norm,
                                  scene.contact.maximum_iterations);
  }



  template <int dim>
  std::unique_ptr<LinearSolver>
  Solvers<dim>::factorise(const SparseMatrix &matrix)
  {
    TimerOutput::Scope phase(phases, "factorisation");
    ++count.factorisations;
    return std::make_unique<Cholesky>(matrix);
  }



  template <int dim>
  ContactSolver &
  Solvers<dim>::contact_solver()
  {
    return *contact;
  }



  template <int dim>
  const SparseMatrix &
  Solvers<dim>::stiffness() const
  {
    return matrix;
  }



  template <int dim>
  LinearSolver &
  Solvers<dim>::direct_solver()
  {
    if (direct_open == nullptr)
      direct_open = factorise(matrix);
    return *direct_open;
  }



  template <int dim>
  Vector
  Solvers<dim>::elastic_displacement(const Vector &loads, const bool lip_closed)
  {
    Vector displacement(loads);
    if (!lip_closed)
      {
        direct_solver().solve(displacement, loads);
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
                                  fixed_points<dim>(scene));
    SparseMatrix     closed_matrix;
    assemble_stiffness(closed_space, body.law.stiffness(), closed_matrix);
    ++count.assemblies;

    Vector closed_loads(loads);
    closed_space.constraints().set_zero(closed_loads);
    direct_closed = factorise(closed_matrix);
    direct_closed->solve(displacement, closed_loads);
    return displacement;
  }



  template <int dim>
  const Counters &
  Solvers<dim>::counters() const
  {
    return count;
  }



  template <int dim>
  std::size_t
  Solvers<dim>::n_linear_solves() const
  {
    return (direct_open != nullptr ? direct_open->n_solves() : 0) +
           (direct_closed != nullptr ? direct_closed->n_solves() : 0);
  }



  template <int dim>
  double
  Solvers<dim>::linear_seconds() const
  {
    return (direct_open != nullptr ? direct_open->seconds() : 0.) +
           (direct_closed != nullptr ? direct_closed->seconds() : 0.);
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
  template Vector
  loads_at<2>(const Body<2> &, const double);
  template unsigned int
  step_of_largest_load<2>(const Body<2> &, const StepList &);
} // namespace Crevasse
