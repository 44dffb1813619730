// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/machine_memory.h>
#include <crevasse/base/problems.h>
#include <crevasse/base/text.h>
#include <crevasse/model/linear_choice.h>
#include <crevasse/model/mesh_room.h>
#include <crevasse/model/solver_memory.h>

#include <deal.II/base/utilities.h>

#include <cmath>

namespace Crevasse
{
  using namespace dealii;

  namespace
  {
    /** Of a cell with the numbers of its unknowns, and of one of the first
     * mesh, which every rank has: less than any that was measured. */
    template <int dim>
    constexpr double bytes_per_cell = dim == 2 ? 250. : 400.;
    template <int dim>
    constexpr double bytes_per_first_cell = dim == 2 ? 350. : 800.;
  } // namespace



  template <int dim>
  void
  require_room(const Scene      &scene,
               const CellCounts &cells,
               const MPI_Comm    communicator)
  {
    const unsigned int n_ranks  = Utilities::MPI::n_mpi_processes(communicator);
    const unsigned int degree   = scene.discretisation.degree;
    const double       per_cell = dim * std::pow(degree, dim);
    const double       unknowns = per_cell * cells.all;
    const bool         has_coarser = scene.geometry.refinements > 0 &&
                             scene.discretisation.singular_functions == 0 &&
                             per_cell * cells.first <= largest_factorised(dim);
    const LinearSolverChoice solver = choose_linear_solver(
      scene.linear_solver, dim, degree, unknowns, n_ranks, has_coarser);
    if (solver.type == LinearSolverType::amg)
      require_work_for_ml<dim>(unknowns / n_ranks, unknowns, degree, n_ranks);

    const double needed =
      (bytes_per_first_cell<dim> * cells.first +
       (bytes_per_cell<dim> * cells.all +
        least_bytes_of_solver<dim>(solver.type, unknowns, degree, n_ranks)) /
         n_ranks);
    const double all   = sum_on_machine(needed, communicator);
    const double there = available_memory(communicator);
    if (Utilities::MPI::max(all / there, communicator) <= memory_uncertainty)
      return;
    throw SceneError(
      "[Geometry]: a mesh of about " + Text::from_number(cells.all) +
      " cells (" + Text::from_number(unknowns) + " unknowns) needs at least " +
      gigabytes(Utilities::MPI::max(all, communicator)) +
      " of memory with the linear solver " + solver.describe() +
      ", on a machine that has " +
      gigabytes(Utilities::MPI::min(there, communicator)) +
      " left. Take fewer Subdivisions or Refinements" +
      (solver.type == LinearSolverType::gmg || dim == 2
         ? ""
         : ", or fewer Subdivisions and more Refinements with [Linear solver] "
           "Type = gmg") +
      ", or processes on more machines.");
  }



  template void
  require_room<2>(const Scene &, const CellCounts &, const MPI_Comm);
  template void
  require_room<3>(const Scene &, const CellCounts &, const MPI_Comm);
} // namespace Crevasse
