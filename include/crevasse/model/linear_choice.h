// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_model_linear_choice_h
#define crevasse_model_linear_choice_h

#include <crevasse/grid/geometry.h>
#include <crevasse/linear/solver_choice.h>
#include <crevasse/model/body.h>

namespace Crevasse
{
  /** The solvers of a run for linear systems and contact problems. */
  struct SolverChoice
  {
    LinearSolverChoice  linear;
    ContactSolverChoice contact;
  };

  /** Chooses solvers for a scene on a body. Collective.
   * @throw SceneError if the scene asks for a solver that cannot be used. */
  template <int dim>
  SolverChoice
  choose_solvers(const Scene &scene, const Body<dim> &body);

  /** Approximate number of unknowns on the mesh before refinement: the coarsest
   * level of geometric multigrid, unless that is refined itself. */
  template <int dim>
  double
  n_unknowns_of_first_mesh(const Body<dim> &body);

  /**
   * Bytes, on all ranks, of a stiffness and its solver: the matrix and its
   * factor, which grows with n log n in the plane and n^(4/3) in space (nested
   * dissection); twice the matrix for algebraic multigrid; vectors and the
   * solver of the first mesh for geometric multigrid. One measured constant for
   * each.
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

  /** Checks before a mesh is created whether there is memory for it, as the
   * attempt could take minutes, or all memory. Counts mesh and linear solver
   * only; report_memory() is more precise once there is a mesh. Collective.
   * @throw SceneError if the machine has less memory left, or the linear solver
   * cannot have so many unknowns. */
  template <int dim>
  void
  require_room(const Scene      &scene,
               const CellCounts &cells,
               const MPI_Comm    communicator);
} // namespace Crevasse

#endif
