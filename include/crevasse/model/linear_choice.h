// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_model_linear_choice_h
#define crevasse_model_linear_choice_h

#include <crevasse/linear/solver_choice.h>
#include <crevasse/model/body.h>

namespace Crevasse
{
  /** Whether [Linear solver] Type = gmg can be had and pays: nothing needs a
   * matrix, and the first mesh is so coarse that a factorisation solves on
   * it. */
  template <int dim>
  bool
  may_use_gmg(const Scene &scene, const Body<dim> &body);

  /** The linear solver of a scene on a body. Collective.
   * @throw SceneError if the scene asks for one that does not work here. */
  template <int dim>
  LinearSolverChoice
  choose_linear_solver(const Scene &scene, const Body<dim> &body);

  /** The contact solver of a scene on a body. Collective.
   * @throw SceneError if it works on one process only and there are more. */
  template <int dim>
  ContactSolverChoice
  choose_contact_solver(const Scene              &scene,
                        const Body<dim>          &body,
                        const LinearSolverChoice &linear_solver);

  /** What solves the linear systems and the contact problems of a run. */
  struct SolverChoice
  {
    LinearSolverChoice  linear;
    ContactSolverChoice contact;
  };

  /** Both for a scene on a body. Collective. @throw SceneError see above */
  template <int dim>
  SolverChoice
  choose_solvers(const Scene &scene, const Body<dim> &body);

  /** That of the mesh without its refinements, roughly: the coarsest one of
   * geometric multigrid, unless that is refined itself. */
  template <int dim>
  double
  n_unknowns_of_first_mesh(const Body<dim> &body);

  /** Entries of so many rows of a stiffness: on average 3 (degree 1) or 4
   * (degree 2) nodes along each direction share a cell with a node, each with
   * dim components. */
  template <int dim>
  double
  n_matrix_entries(const double n_rows, const unsigned int degree);

  /** ML counts the entries of a process with 32 bits.
   * @param n_own_unknowns of the process with most.
   * @throw SceneError if they are more than it can do with. */
  template <int dim>
  void
  require_work_for_ml(const double       n_own_unknowns,
                      const double       n_unknowns,
                      const unsigned int degree,
                      const unsigned int n_ranks);
} // namespace Crevasse

#endif
