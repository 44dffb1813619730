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

#ifndef crevasse_run_solvers_h
#define crevasse_run_solvers_h

#include <crevasse/contact/contact_solver.h>
#include <crevasse/contact/sweep.h>
#include <crevasse/linear/linear_solver.h>
#include <crevasse/linear/solver_choice.h>
#include <crevasse/output/log.h>
#include <crevasse/output/summary.h>
#include <crevasse/run/body.h>
#include <crevasse/scene/scene.h>
#include <crevasse/time/step_list.h>

#include <deal.II/base/timer.h>

#include <memory>

namespace Crevasse
{
  /**
   * The stiffness of a body and what solves with it. The matrix is assembled
   * once; the linear solver is prepared when it is asked for, not before.
   */
  template <int dim>
  class Solvers
  {
  public:
    /** Assembles and prepares the contact solver that the scene asks for. All
     * arguments must outlive this object. */
    Solvers(const Scene         &scene,
            const Body<dim>     &body,
            const StepList      &steps,
            Log                 &log,
            dealii::TimerOutput &phases);

    ContactSolver &
    contact_solver();

    const SignoriniProblem &
    contact_problem() const;

    const SparseMatrix &
    stiffness() const;

    /** The unknowns that a sweep of projected SOR relaxes together; none: one
     * by one. */
    const UnknownBlocks &
    blocks() const;

    /** The elastic displacement under the given loads with the lip open or
     * held at u_N = 0. */
    Vector
    elastic_displacement(const Vector &loads, const bool lip_closed);

    /** Which solvers there are and why, how often they were called and what it
     * took. */
    void
    summarise(Summary &summary) const;

  private:
    std::unique_ptr<LinearSolver>
    make_linear_solver(const SparseMatrix &matrix, const Space<dim> &space);

    /** The linear solver for the body with an open lip. */
    LinearSolver &
    linear_solver();

    std::unique_ptr<ContactSolver>
    make_contact_solver(const StepList &steps);

    /** By the largest nodal force of all steps. */
    double
    largest_load(const StepList &steps) const;

    /** How often the expensive things were done. */
    struct Counters
    {
      unsigned int assemblies       = 0;
      unsigned int factorisations   = 0;
      unsigned int multigrid_setups = 0;
    };

    /** A sum over the linear solvers that exist. */
    template <typename Number>
    Number
    total(Number (LinearSolver::*count)() const) const;

    double
    relaxation_factor(const StepList &steps);

    const Scene              &scene;
    const Body<dim>          &body;
    Log                      &log;
    dealii::TimerOutput      &phases;
    const LinearSolverChoice  linear_choice;
    const ContactSolverChoice contact_choice;

    SparseMatrix                            matrix;
    const UnilateralBounds                  bounds;
    UnknownBlocks                           unknown_blocks;
    std::unique_ptr<const SignoriniProblem> problem;
    std::unique_ptr<LinearSolver>           open_solver;
    std::unique_ptr<ContactSolver>          contact;
    Counters                                count;
    SparseMatrix                            closed_matrix;
    std::unique_ptr<LinearSolver>           closed_solver;
  };

  /** The step of a period at which the load vector is largest. */
  template <int dim>
  unsigned int
  step_of_largest_load(const Body<dim> &body, const StepList &steps);

  /** The load vector at an instant of the period. */
  template <int dim>
  Vector
  loads_at(const Body<dim> &body, const double t);
} // namespace Crevasse

#endif
