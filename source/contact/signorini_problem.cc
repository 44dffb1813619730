// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/problems.h>
#include <crevasse/contact/signorini_problem.h>
#include <crevasse/linear/matrix_operator.h>

#include <deal.II/base/mpi.h>

namespace Crevasse
{
  using namespace dealii;

  SignoriniProblem::SignoriniProblem(const LinearOperator   &stiffness,
                                     const UnilateralBounds &bounds)
    : stiffness(stiffness)
    , bounds(bounds)
    , n_all_bounds(Utilities::MPI::sum(static_cast<types::global_dof_index>(
                                         bounds.dofs.size()),
                                       stiffness.get_mpi_communicator()))
  {
    require_positive_diagonal();
  }



  SignoriniProblem::SignoriniProblem(const SparseMatrix     &matrix,
                                     const UnilateralBounds &bounds)
    : of_matrix(std::make_unique<MatrixOperator>(matrix))
    , stiffness(*of_matrix)
    , bounds(bounds)
    , n_all_bounds(Utilities::MPI::sum(static_cast<types::global_dof_index>(
                                         bounds.dofs.size()),
                                       matrix.get_mpi_communicator()))
  {
    require_positive_diagonal();
  }



  void
  SignoriniProblem::require_positive_diagonal() const
  {
    for (const auto i : diagonal().locally_owned_elements())
      if (!(diagonal()(i) > 0.))
        throw NumericalError(
          "Diagonal entry " + std::to_string(i) + " of the stiffness is " +
          std::to_string(diagonal()(i)) +
          ", so that the stiffness is not positive definite. Check the "
          "moduli of [Material] and the mesh for inverted cells.");
  }



  const SparseMatrix &
  SignoriniProblem::matrix() const
  {
    if (stiffness.matrix() == nullptr)
      throw SceneError(
        "[Linear solver] Type = gmg: there is no matrix, whose "
        "entries this scene needs; choose another type.");
    return *stiffness.matrix();
  }



  const Vector &
  SignoriniProblem::diagonal() const
  {
    return stiffness.diagonal();
  }
} // namespace Crevasse
