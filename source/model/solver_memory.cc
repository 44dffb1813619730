// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/machine_memory.h>
#include <crevasse/base/problems.h>
#include <crevasse/base/text.h>
#include <crevasse/model/linear_choice.h>
#include <crevasse/model/solver_memory.h>

#include <deal.II/base/utilities.h>

#include <algorithm>
#include <cmath>

namespace Crevasse
{
  using namespace dealii;

  template <int dim>
  double
  bytes_of_solver(const LinearSolverType type,
                  const double           n_unknowns,
                  const double           n_coarsest,
                  const unsigned int     degree,
                  const unsigned int     n_ranks)
  {
    using Choice = LinearSolverType;
    if (type == Choice::gmg)
      return sizeof(double) * (degree == 1 ? 60. : 25.) * n_unknowns +
             bytes_of_solver<dim>(
               choose_matrix_solver(dim, n_coarsest, n_ranks).type,
               n_coarsest,
               0.,
               degree,
               n_ranks);

    // An entry is a value and a column.
    const double matrix = (sizeof(double) + sizeof(int)) *
                          n_matrix_entries<dim>(n_unknowns, degree);
    if (type == Choice::amg)
      return 2. * matrix;
    const double factor =
      dim == 2 ? 127. * n_unknowns * std::log2(std::max(n_unknowns, 2.))
               : 190. * std::pow(n_unknowns, 4. / 3.);
    const double of_mumps = dim == 2 ? 1.3 : 2.1;
    return matrix + (type == Choice::mumps ? of_mumps : 1.) * factor;
  }



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
    const double       coarsest = per_cell * cells.first;
    const bool         has_coarser = scene.geometry.refinements > 0 &&
                             scene.discretisation.singular_functions == 0 &&
                             coarsest <= largest_factorised(dim);
    const LinearSolverChoice solver = choose_linear_solver(
      scene.linear_solver, dim, degree, unknowns, n_ranks, has_coarser);
    if (solver.type == LinearSolverType::amg)
      require_work_for_ml<dim>(unknowns / n_ranks, unknowns, degree, n_ranks);

    // Less than any mesh that was measured; each rank has all of the first one.
    constexpr double bytes_per_cell = dim == 2 ? 250. : 400.;
    const double     needed =
      bytes_per_cell * cells.first +
      (bytes_per_cell * cells.all +
       bytes_of_solver<dim>(solver.type, unknowns, coarsest, degree, n_ranks)) /
        n_ranks;
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



#define INSTANTIATE(dim)                                       \
  template double bytes_of_solver<dim>(const LinearSolverType, \
                                       const double,           \
                                       const double,           \
                                       const unsigned int,     \
                                       const unsigned int);    \
  template void   require_room<dim>(const Scene &,             \
                                  const CellCounts &,        \
                                  const MPI_Comm)

  INSTANTIATE(2);
  INSTANTIATE(3);

#undef INSTANTIATE
} // namespace Crevasse
