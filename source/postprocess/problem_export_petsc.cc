// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

// Apart from the rest of problem_export: PETSc's headers define macros that
// others trip over.

#include <crevasse/base/problems.h>
#include <crevasse/postprocess/problem_export.h>

#include <deal.II/lac/exceptions.h>

#include <Epetra_CrsMatrix.h>
#include <algorithm>
#include <petscmat.h>
#include <petscvec.h>
#include <petscviewer.h>
#include <utility>
#include <vector>

namespace Crevasse
{
  namespace
  {
    void
    require(const PetscErrorCode error)
    {
      AssertThrow(error == 0, dealii::ExcPETScError(error));
    }



    /** A's rows with global column numbers, as PETSc's. */
    Mat
    petsc_matrix(const SparseMatrix &matrix)
    {
      const Epetra_CrsMatrix &epetra = matrix.trilinos_matrix();
      const int               n      = epetra.NumMyRows();
      std::vector<PetscInt>   starts(1, 0), columns;
      std::vector<double>     values;
      for (int row = 0; row < n; ++row)
        {
          int     n_entries;
          int    *indices;
          double *entries;
          epetra.ExtractMyRowView(row, n_entries, entries, indices);
          std::vector<std::pair<PetscInt, double>> sorted;
          for (int k = 0; k < n_entries; ++k)
            sorted.emplace_back(epetra.GCID(indices[k]), entries[k]);
          std::sort(sorted.begin(), sorted.end());
          for (const auto &[column, value] : sorted)
            {
              columns.push_back(column);
              values.push_back(value);
            }
          starts.push_back(columns.size());
        }
      Mat result;
      require(MatCreateMPIAIJWithArrays(matrix.get_mpi_communicator(),
                                        n,
                                        n,
                                        matrix.m(),
                                        matrix.n(),
                                        starts.data(),
                                        columns.data(),
                                        values.data(),
                                        &result));
      return result;
    }



    void
    write_vector(const MPI_Comm             communicator,
                 const std::vector<double> &values,
                 PetscViewer                viewer)
    {
      Vec vector;
      require(VecCreateMPIWithArray(
        communicator, 1, values.size(), PETSC_DECIDE, values.data(), &vector));
      require(VecView(vector, viewer));
      require(VecDestroy(&vector));
    }
  } // namespace



  void
  write_petsc_binary(const SignoriniProblem &problem,
                     const Vector           &right_hand_side,
                     const Vector           &solution,
                     const std::string      &name)
  {
    const MPI_Comm    communicator = problem.stiffness.get_mpi_communicator();
    const std::string file_name    = name + ".petsc";

    // sign q >= gap is a lower bound, or for sign = -1 an upper one.
    const unsigned int  n = right_hand_side.locally_owned_size();
    std::vector<double> lower(n, PETSC_NINFINITY), upper(n, PETSC_INFINITY);
    const auto         &numbering = *right_hand_side.get_partitioner();
    for (std::size_t k = 0; k < problem.bounds.dofs.size(); ++k)
      {
        const auto i = numbering.global_to_local(problem.bounds.dofs[k]);
        if (problem.bounds.sign[k] > 0.)
          lower[i] = problem.bounds.gap[k];
        else
          upper[i] = -problem.bounds.gap[k];
      }

    PetscViewer viewer;
    require(PetscPushErrorHandler(PetscReturnErrorHandler, nullptr));
    const PetscErrorCode opened = PetscViewerBinaryOpen(communicator,
                                                        file_name.c_str(),
                                                        FILE_MODE_WRITE,
                                                        &viewer);
    require(PetscPopErrorHandler());
    if (opened != 0)
      throw FileError("Cannot write " + file_name + ".");
    Mat matrix = petsc_matrix(problem.matrix());
    require(MatView(matrix, viewer));
    require(MatDestroy(&matrix));
    write_vector(communicator,
                 {right_hand_side.begin(), right_hand_side.end()},
                 viewer);
    write_vector(communicator, lower, viewer);
    write_vector(communicator, upper, viewer);
    write_vector(communicator, {solution.begin(), solution.end()}, viewer);
    require(PetscViewerDestroy(&viewer));
  }
} // namespace Crevasse
