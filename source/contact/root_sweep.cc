// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/contact/root_sweep.h>

#include <deal.II/base/mpi.h>

#include <Epetra_CrsMatrix.h>
#include <Epetra_Vector.h>


namespace Crevasse
{
  using namespace dealii;

  namespace
  {
    bool
    is_root(const Epetra_Map &map)
    {
      return map.Comm().MyPID() == 0;
    }



    Epetra_Map
    all_at_root(const Epetra_Map &map)
    {
      const int n = map.NumGlobalElements();
      return Epetra_Map(n, is_root(map) ? n : 0, 0, map.Comm());
    }



    SparseMatrix
    matrix_at_root(const SparseMatrix  &matrix,
                   const Epetra_Map    &rows_at_root,
                   const Epetra_Import &importer)
    {
      Epetra_CrsMatrix all(Copy, rows_at_root, 0);
      int error = all.Import(matrix.trilinos_matrix(), importer, Insert);
      AssertThrow(error == 0, ExcTrilinosError(error));
      error = all.FillComplete(rows_at_root, rows_at_root);
      AssertThrow(error == 0, ExcTrilinosError(error));
      SparseMatrix copy;
      copy.reinit(all);
      return copy;
    }



    /** What all ranks have, on the first. */
    template <typename T>
    std::vector<T>
    joined_at_root(const std::vector<T> &mine, const MPI_Comm communicator)
    {
      std::vector<T> all;
      for (const auto &part : Utilities::MPI::gather(communicator, mine))
        all.insert(all.end(), part.begin(), part.end());
      return all;
    }



    UnilateralBounds
    bounds_at_root(const UnilateralBounds &bounds, const MPI_Comm communicator)
    {
      UnilateralBounds all;
      all.dofs     = joined_at_root(bounds.dofs, communicator);
      all.sign     = joined_at_root(bounds.sign, communicator);
      all.gap      = joined_at_root(bounds.gap, communicator);
      all.n_global = Utilities::MPI::sum(bounds.n_global, communicator);
      return all;
    }
  } // namespace



  RootSweep::RootSweep(const SignoriniProblem &problem,
                       const UnknownBlocks    &blocks)
    : rows(problem.matrix().trilinos_matrix().RowMap())
    , rows_at_root(all_at_root(rows))
    , importer(rows_at_root, rows)
    , matrix(matrix_at_root(problem.matrix(), rows_at_root, importer))
    , bounds(bounds_at_root(problem.bounds,
                            problem.stiffness.get_mpi_communicator()))
    , problem(matrix, bounds)
    , sweep(make_local_sweep(
        this->problem,
        joined_at_root(blocks, problem.stiffness.get_mpi_communicator())))
  {
  }



  Vector
  RootSweep::at_root(const Vector &distributed) const
  {
    Vector              all(matrix.locally_owned_range_indices(),
               matrix.get_mpi_communicator());
    const Epetra_Vector source(View,
                               rows,
                               const_cast<double *>(distributed.begin()));
    Epetra_Vector       target(View, rows_at_root, all.begin());
    const int           error = target.Import(source, importer, Insert);
    AssertThrow(error == 0, ExcTrilinosError(error));
    return all;
  }



  void
  RootSweep::from_root(const Vector &all, Vector &distributed) const
  {
    const Epetra_Vector source(View,
                               rows_at_root,
                               const_cast<double *>(all.begin()));
    Epetra_Vector       target(View, rows, distributed.begin());
    const int           error = target.Export(source, importer, Insert);
    AssertThrow(error == 0, ExcTrilinosError(error));
  }



  double
  RootSweep::operator()(const Vector &right_hand_side,
                        Vector       &solution,
                        const double  relaxation_factor) const
  {
    return sweep_until(right_hand_side, solution, relaxation_factor, 0., 1)
      .largest_residual;
  }



  SweepCount
  RootSweep::sweep_until(const Vector      &right_hand_side,
                         Vector            &solution,
                         const double       relaxation_factor,
                         const double       target,
                         const unsigned int maximum_sweeps) const
  {
    const Vector b = at_root(right_hand_side);
    Vector       q = at_root(solution);
    SweepCount   count;
    if (is_root(rows))
      count =
        sweep->sweep_until(b, q, relaxation_factor, target, maximum_sweeps);
    from_root(q, solution);
    const MPI_Comm communicator = matrix.get_mpi_communicator();
    return {Utilities::MPI::broadcast(communicator, count.sweeps),
            Utilities::MPI::broadcast(communicator, count.largest_residual)};
  }
} // namespace Crevasse
