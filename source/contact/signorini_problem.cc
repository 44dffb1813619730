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

#include <crevasse/contact/signorini_problem.h>
#include <crevasse/scene/problems.h>

#include <deal.II/base/mpi.h>

namespace Crevasse
{
  using namespace dealii;

  SignoriniProblem::SignoriniProblem(const SparseMatrix     &matrix,
                                     const UnilateralBounds &bounds)
    : matrix(matrix)
    , bounds(bounds)
    , matrix_diagonal(matrix.locally_owned_range_indices(),
                      matrix.get_mpi_communicator())
    , n_all_bounds(Utilities::MPI::sum(static_cast<types::global_dof_index>(
                                         bounds.dofs.size()),
                                       matrix.get_mpi_communicator()))
  {
    for (const auto i : matrix_diagonal.locally_owned_elements())
      {
        matrix_diagonal(i) = matrix.diag_element(i);
        if (!(matrix_diagonal(i) > 0.))
          throw NumericalError(
            "Diagonal entry " + std::to_string(i) + " of the stiffness is " +
            std::to_string(matrix_diagonal(i)) +
            ", so that the stiffness is not positive definite. Check the "
            "moduli of [Material] and the mesh for inverted cells.");
      }
  }



  const Vector &
  SignoriniProblem::diagonal() const
  {
    return matrix_diagonal;
  }



  types::global_dof_index
  SignoriniProblem::n_bounds() const
  {
    return n_all_bounds;
  }
} // namespace Crevasse
