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

#include <crevasse/linear/mumps.h>
#include <crevasse/scene/problems.h>

#include <deal.II/base/mpi.h>

#include <Amesos_Mumps.h>
#include <Epetra_CrsMatrix.h>
#include <Epetra_LinearProblem.h>
#include <Epetra_MultiVector.h>
#include <Teuchos_ParameterList.hpp>
#include <algorithm>
#include <exception>

namespace Crevasse
{
  using namespace dealii;

  struct Mumps::Factor
  {
    explicit Factor(const Matrix &matrix)
      : n_ranks(dealii::Utilities::MPI::n_mpi_processes(
          matrix.get_mpi_communicator()))
      , map(matrix.trilinos_matrix().RowMap())
      , solver(problem)
    {
      // Amesos only reads the matrix.
      problem.SetOperator(
        const_cast<Epetra_CrsMatrix *>(&matrix.trilinos_matrix()));
      Teuchos::ParameterList parameters;
      parameters.set("PrintTiming", false);
      parameters.set("PrintStatus", false);
      parameters.set("OutputLevel", 0);
      parameters.set("MaxProcs", -3); // all ranks, also on small matrices
      solver.SetParameters(parameters);
      require(solver.SymbolicFactorization());
      require(solver.NumericFactorization());
    }

    void
    solve(double *solutions, double *right_hand_sides, const int n_columns)
    {
      const int          n = map.NumMyElements();
      Epetra_MultiVector x(View, map, solutions, n, n_columns);
      Epetra_MultiVector b(View, map, right_hand_sides, n, n_columns);
      problem.SetLHS(&x);
      problem.SetRHS(&b);
      require(solver.Solve());
    }

    /** Amesos answers a failure of MUMPS by a negative number. */
    void
    require(const int status)
    {
      if (status != 0)
        throw NumericalError(
          "MUMPS failed with status " + std::to_string(status) +
          ", INFOG(1) = " + std::to_string(solver.GetINFOG()[0]) +
          ". If memory is short (INFOG(1) = -9 or -13), use more ranks or "
          "[Linear solver] Type = amg. Otherwise the stiffness is singular: "
          "check the moduli of [Material] and the supports of [Boundary].");
    }

    const unsigned int   n_ranks;
    const Epetra_Map    &map;
    Epetra_LinearProblem problem;
    Amesos_Mumps         solver;
  };



  Mumps::Mumps(const Matrix &matrix)
    : factor(std::make_unique<Factor>(matrix))
  {
  }



  Mumps::~Mumps()
  {
    // MUMPS frees its factor by communication. While an exception is on its way
    // the other ranks may be elsewhere: then the memory is left alone, and the
    // end of the process frees it.
    if (factor->n_ranks > 1 && std::uncaught_exceptions() > 0)
      (void)factor.release();
  }



  bool
  Mumps::is_direct() const
  {
    return true;
  }



  std::string
  Mumps::description() const
  {
    return "MUMPS on " + std::to_string(factor->n_ranks) +
           (factor->n_ranks == 1 ? " rank" : " ranks");
  }



  void
  Mumps::precondition(Vector &solution, const Vector &right_hand_side)
  {
    // Amesos only reads the right-hand side.
    factor->solve(solution.begin(),
                  const_cast<double *>(right_hand_side.begin()),
                  1);
  }



  unsigned int
  Mumps::apply_inverse(Vector       &solution,
                       const Vector &right_hand_side,
                       const double)
  {
    precondition(solution, right_hand_side);
    return 0;
  }



  unsigned int
  Mumps::apply_inverse_to_all(std::vector<Vector> &right_hand_sides,
                              const double)
  {
    const std::size_t   n = right_hand_sides.front().locally_owned_size();
    std::vector<double> block(n * right_hand_sides.size());
    for (std::size_t k = 0; k < right_hand_sides.size(); ++k)
      std::copy(right_hand_sides[k].begin(),
                right_hand_sides[k].end(),
                block.begin() + k * n);
    std::vector<double> solutions(block.size());
    factor->solve(solutions.data(), block.data(), right_hand_sides.size());
    for (std::size_t k = 0; k < right_hand_sides.size(); ++k)
      std::copy(solutions.begin() + k * n,
                solutions.begin() + (k + 1) * n,
                right_hand_sides[k].begin());
    return 0;
  }
} // namespace Crevasse
