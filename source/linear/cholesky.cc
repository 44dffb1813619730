// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/problems.h>
#include <crevasse/linear/cholesky.h>
#include <crevasse/linear/matrix_operator.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cholmod.h>
#include <utility>

namespace Crevasse
{
  using namespace dealii;

  struct Cholesky::Factor
  {
    Factor()
    {
      cholmod_start(&common);
      common.print = 0; // errors become exceptions
    }

    ~Factor()
    {
      for (cholmod_dense **vectors : {&solution, &work_1, &work_2})
        cholmod_free_dense(vectors, &common);
      cholmod_free_factor(&L, &common);
      cholmod_finish(&common);
    }

    Factor(const Factor &) = delete;

    void
    require_success() const
    {
      if (common.status < CHOLMOD_OK)
        throw NumericalError("CHOLMOD failed with status " +
                             std::to_string(common.status) +
                             (common.status == CHOLMOD_OUT_OF_MEMORY
                                ? ": the factor does not fit into memory."
                                : "."));
    }

    cholmod_common  common;
    cholmod_factor *L = nullptr;

    // Kept from solve to solve, so that a solve allocates nothing.
    cholmod_dense *solution = nullptr;
    cholmod_dense *work_1   = nullptr;
    cholmod_dense *work_2   = nullptr;
  };



  void
  Cholesky::require_one_process(const MPI_Comm communicator)
  {
    if (Utilities::MPI::n_mpi_processes(communicator) > 1)
      throw SceneError(
        "[Linear solver] Type = cholesky works on one process only. Start the "
        "program without mpirun, or choose automatic, mumps, amg or gmg.");
  }



  Cholesky::Cholesky(const Matrix                 &matrix,
                     std::shared_ptr<const Factor> same_pattern)
    : pattern(std::move(same_pattern))
    , factor(std::make_unique<Factor>())
  {
    require_one_process(matrix.get_mpi_communicator());

    // Row i of the symmetric matrix is CHOLMOD's column i, of which it reads
    // what is in the upper triangle.
    const MatrixRows rows(matrix);
    cholmod_sparse   A{};
    A.nrow = A.ncol = rows.n;
    A.nzmax         = rows.starts[rows.n];
    A.p             = rows.starts;
    A.i             = rows.columns;
    A.x             = rows.values;
    A.stype = A.sorted = A.packed = 1;
    A.itype                       = CHOLMOD_INT;
    A.xtype                       = CHOLMOD_REAL;
    A.dtype                       = CHOLMOD_DOUBLE;
    if (pattern == nullptr)
      {
        auto analysis = std::make_shared<Factor>();
        // CHOLMOD's own choice, approximate minimum degree, is the quickest to
        // find; on larger matrices nested dissection leaves a smaller factor
        // (measured: doc/contact_solvers.md).
        constexpr int large = 300000;
        if (rows.n > large)
          {
            analysis->common.nmethods           = 1;
            analysis->common.method[0].ordering = CHOLMOD_NESDIS;
          }
        analysis->L = cholmod_analyze(&A, &analysis->common);
        analysis->require_success();
        pattern = analysis;
      }
    factor->L = cholmod_copy_factor(pattern->L, &factor->common);
    factor->require_success();
    cholmod_factorize(&A, factor->L, &factor->common);
    factor->require_success();
    if (factor->common.status == CHOLMOD_NOT_POSDEF)
      throw NumericalError(
        "CHOLMOD: the stiffness is not positive definite (pivot " +
        std::to_string(factor->L->minor) + " of " + std::to_string(matrix.m()) +
        "). Check the moduli of [Material], the supports of [Boundary], and "
        "the mesh for inverted cells or parts that hang together by nothing.");
  }



  Cholesky::~Cholesky() = default;



  std::size_t
  Cholesky::memory_consumption() const
  {
    return factor->common.memory_inuse;
  }



  std::string
  Cholesky::description() const
  {
    return std::string("sparse Cholesky (CHOLMOD), ") +
           (factor->L->is_super != 0 ? "supernodal" : "simplicial") + ", " +
           std::to_string(std::size_t(pattern->common.lnz)) +
           " entries in the factor";
  }



  void
  Cholesky::back_solve(double            *solutions,
                       const double      *right_hand_sides,
                       const unsigned int n_columns)
  {
    const std::size_t n = factor->L->n;
    cholmod_dense     b{};
    b.nrow = b.d = n;
    b.ncol       = n_columns;
    b.nzmax      = n * n_columns;
    b.x          = const_cast<double *>(right_hand_sides); // only read
    b.xtype      = CHOLMOD_REAL;
    b.dtype      = CHOLMOD_DOUBLE;
    cholmod_solve2(CHOLMOD_A,
                   factor->L,
                   &b,
                   nullptr,
                   &factor->solution,
                   nullptr,
                   &factor->work_1,
                   &factor->work_2,
                   &factor->common);
    factor->require_success();
    std::copy_n(static_cast<const double *>(factor->solution->x),
                n * n_columns,
                solutions);
  }
} // namespace Crevasse
