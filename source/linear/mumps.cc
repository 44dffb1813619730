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
    solve(double            *solutions,
          const double      *right_hand_sides,
          const unsigned int n_columns)
    {
      const int          n = map.NumMyElements();
      Epetra_MultiVector x(View, map, solutions, n, n_columns);
      // Amesos only reads the right-hand sides.
      Epetra_MultiVector b(
        View, map, const_cast<double *>(right_hand_sides), n, n_columns);
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



  std::size_t
  Mumps::memory_consumption() const
  {
    // INFO(16): the space that the factorisation was given, in 10⁶ bytes.
    return std::size_t(1000000) * factor->solver.GetINFO()[15];
  }



  std::string
  Mumps::description() const
  {
    return "MUMPS on " + std::to_string(factor->n_ranks) +
           (factor->n_ranks == 1 ? " rank" : " ranks");
  }



  void
  Mumps::back_solve(double            *solutions,
                    const double      *right_hand_sides,
                    const unsigned int n_columns)
  {
    factor->solve(solutions, right_hand_sides, n_columns);
  }
} // namespace Crevasse
