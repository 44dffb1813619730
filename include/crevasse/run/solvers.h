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
#include <crevasse/linear/linear_solver.h>
#include <crevasse/output/log.h>
#include <crevasse/run/body.h>
#include <crevasse/scene/scene.h>
#include <crevasse/time/step_list.h>

#include <deal.II/base/timer.h>

#include <memory>

namespace Crevasse
{
  /** How often the expensive things were done; they go to the summary. */
  struct Counters
  {
    unsigned int assemblies     = 0;
    unsigned int factorisations = 0;
  };

  /**
   * The stiffness of a body and what solves with it. The matrix is assembled
   * once; it is factorised when the direct solver is asked for, not before.
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

    const SparseMatrix &
    stiffness() const;

    /** The direct solver for the stiffness of the body with an open lip. */
    LinearSolver &
    direct_solver();

    /** The elastic displacement under the given loads, by the direct solver,
     * with the lip open or held at u_N = 0. */
    Vector
    elastic_displacement(const Vector &loads, const bool lip_closed);

    const Counters &
    counters() const;

    /** Solves by direct solvers. */
    std::size_t
    n_linear_solves() const;

    /** Wall time of these. */
    double
    linear_seconds() const;

  private:
    std::unique_ptr<LinearSolver>
    factorise(const SparseMatrix &matrix);

    std::unique_ptr<ContactSolver>
    make_contact_solver(const StepList &steps);

    double
    relaxation_factor(const StepList &steps);

    const Scene         &scene;
    const Body<dim>     &body;
    dealii::TimerOutput &phases;

    SparseMatrix                            matrix;
    const UnilateralBounds                  bounds;
    std::unique_ptr<const SignoriniProblem> problem;
    std::unique_ptr<LinearSolver>           direct_open;
    std::unique_ptr<ContactSolver>          contact;
    Counters                                count;
    std::unique_ptr<LinearSolver>           direct_closed;
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
