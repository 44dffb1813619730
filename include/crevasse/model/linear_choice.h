// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_model_linear_choice_h
#define crevasse_model_linear_choice_h

#include <crevasse/grid/geometry.h>
#include <crevasse/linear/solver_choice.h>
#include <crevasse/model/body.h>

namespace Crevasse
{
  /** What solves the linear systems and the contact problems of a run. */
  struct SolverChoice
  {
    LinearSolverChoice  linear;
    ContactSolverChoice contact;
  };

  /** For a scene on a body. Collective.
   * @throw SceneError if the scene asks for one that does not work here. */
  template <int dim>
  SolverChoice
  choose_solvers(const Scene &scene, const Body<dim> &body);

  /** That of the mesh without its refinements, roughly: the coarsest one of
   * geometric multigrid, unless that is refined itself. */
  template <int dim>
  double
  n_unknowns_of_first_mesh(const Body<dim> &body);

  /** By which factor estimates of memory may be wrong (doc/scaling.md). */
  constexpr double memory_uncertainty = 1.3;

  /**
   * Bytes, on all ranks, of a stiffness and what solves with it: the matrix and
   * its factor, which grows with n log n in the plane and n^(4/3) in space
   * (nested dissection); twice the matrix for algebraic multigrid; vectors and
   * the solver of the first mesh for geometric multigrid. One measured constant
   * for each.
   *
   * @param n_coarsest unknowns of the first mesh.
   */
  template <int dim>
  double
  bytes_of_solver(const LinearSolverType type,
                  const double           n_unknowns,
                  const double           n_coarsest,
                  const unsigned int     degree,
                  const unsigned int     n_ranks);

  /** Looks before a mesh is made whether it can be computed on: making one that
   * cannot takes minutes, or all memory. Counts mesh and linear solver only;
   * report_memory() knows more, once there is a mesh. Collective.
   * @throw SceneError if the machine has less than that left, or the linear
   * solver cannot have so many unknowns. */
  template <int dim>
  void
  require_room(const Scene      &scene,
               const CellCounts &cells,
               const MPI_Comm    communicator);
} // namespace Crevasse

#endif
