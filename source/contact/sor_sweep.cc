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

#include <crevasse/contact/sor_sweep.h>
#include <crevasse/scene/problems.h>

#include <deal.II/base/mpi.h>

#include <Epetra_CrsMatrix.h>
#include <algorithm>
#include <cmath>
#include <limits>

namespace Crevasse
{
  using namespace dealii;

  SorSweep::SorSweep(const SignoriniProblem &problem)
    : problem(problem)
    , bound_of(problem.matrix.m(), -1)
  {
    if (Utilities::MPI::n_mpi_processes(problem.matrix.get_mpi_communicator()) >
        1)
      throw NumericalError(
        "Projected SOR sweeps through all unknowns in order and works on one "
        "process only: start the program without mpirun.");

    int      *starts;
    int      *indices;
    double   *entries;
    const int error =
      problem.matrix.trilinos_matrix().ExtractCrsDataPointers(starts,
                                                              indices,
                                                              entries);
    AssertThrow(error == 0, ExcTrilinosError(error));
    row_starts = starts;
    columns    = indices;
    values     = entries;

    for (unsigned int k = 0; k < problem.bounds.dofs.size(); ++k)
      bound_of[problem.bounds.dofs[k]] = k;
  }



  double
  SorSweep::operator()(const Vector &right_hand_side,
                       Vector       &solution,
                       const double  relaxation_factor) const
  {
    double *const       q        = solution.begin();
    const double *const b        = right_hand_side.begin();
    const double *const diagonal = problem.diagonal().begin();

    double largest_residual = 0., sum = 0.;
    for (std::size_t i = 0; i < bound_of.size(); ++i)
      {
        double residual = b[i];
        for (int k = row_starts[i]; k < row_starts[i + 1]; ++k)
          residual -= values[k] * q[columns[k]];

        double    next  = q[i] + relaxation_factor * residual / diagonal[i];
        const int bound = bound_of[i];
        if (bound >= 0)
          {
            const double sign = problem.bounds.sign[bound];
            const double gap  = problem.bounds.gap[bound];
            if (sign * next <= gap)
              {
                // What pushes against the bound is a contact force; what a
                // moving unknown still lacks counts by its movement.
                next     = sign * gap;
                residual = diagonal[i] * (next - q[i]);
              }
          }
        q[i] = next;
        sum += next;
        largest_residual = std::max(largest_residual, std::abs(residual));
      }
    // A diverged iterate shows in the sum; the maximum would overlook nan.
    return std::isfinite(sum) ? largest_residual
                              : std::numeric_limits<double>::infinity();
  }
} // namespace Crevasse
