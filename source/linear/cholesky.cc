// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/problems.h>
#include <crevasse/linear/cholesky.h>
#include <crevasse/linear/matrix_rows.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cholmod.h>
#include <sstream>
#include <utility>

namespace Crevasse
{
  using namespace dealii;

  /** CHOLMOD's settings and workspace. */
  struct Cholesky::Common : cholmod_common
  {
    Common()
    {
      cholmod_start(this);
      print = 0; // errors become exceptions
    }

    ~Common()
    {
      cholmod_finish(this);
    }

    Common(const Common &) = delete;
    Common &
    operator=(const Common &) = delete;
  };



  struct Cholesky::Analysis
  {
    ~Analysis()
    {
      cholmod_free_factor(&pattern, &common);
    }

    Common          common;
    cholmod_factor *pattern = nullptr; ///< without numbers
  };



  struct Cholesky::Factor
  {
    ~Factor()
    {
      cholmod_free_dense(&solution, &common);
      cholmod_free_dense(&work_1, &common);
      cholmod_free_dense(&work_2, &common);
      cholmod_free_factor(&L, &common);
    }

    void
    solve(double            *solutions,
          const double      *right_hand_sides,
          const unsigned int n_columns)
    {
      cholmod_dense b;
      b.nrow  = L->n;
      b.ncol  = n_columns;
      b.nzmax = L->n * n_columns;
      b.d     = L->n;
      b.x     = const_cast<double *>(right_hand_sides); // only read
      b.z     = nullptr;
      b.xtype = CHOLMOD_REAL;
      b.dtype = CHOLMOD_DOUBLE;

      const int success = cholmod_solve2(CHOLMOD_A,
                                         L,
                                         &b,
                                         nullptr,
                                         &solution,
                                         nullptr,
                                         &work_1,
                                         &work_2,
                                         &common);
      if (success == 0)
        throw NumericalError("CHOLMOD: a solve failed with status " +
                             std::to_string(common.status) + ".");
      const auto *x = static_cast<const double *>(solution->x);
      std::copy(x, x + L->n * n_columns, solutions);
    }

    Common          common;
    cholmod_factor *L = nullptr;

    // Kept from solve to solve, so that a solve allocates nothing.
    cholmod_dense *solution = nullptr;
    cholmod_dense *work_1   = nullptr;
    cholmod_dense *work_2   = nullptr;
  };



  namespace
  {
    /** The upper triangle: row i of the symmetric matrix is CHOLMOD's column
     * i. The caller frees it. */
    cholmod_sparse *
    copy_for_cholmod(const LinearSolver::Matrix &matrix, cholmod_common &common)
    {
      const MatrixRows rows(matrix);
      const int        n       = rows.n;
      std::size_t      n_upper = 0;
      for (int i = 0; i < n; ++i)
        n_upper += std::count_if(rows.columns + rows.starts[i],
                                 rows.columns + rows.starts[i + 1],
                                 [i](const int j) { return j <= i; });

      cholmod_sparse *upper =
        cholmod_allocate_sparse(n, n, n_upper, 0, 1, 1, CHOLMOD_REAL, &common);
      if (upper == nullptr)
        throw NumericalError("CHOLMOD: no memory for a matrix of " +
                             std::to_string(n_upper) + " entries.");
      auto *p = static_cast<int *>(upper->p);
      auto *r = static_cast<int *>(upper->i);
      auto *x = static_cast<double *>(upper->x);
      int   k = 0;
      for (int i = 0; i < n; ++i)
        {
          p[i] = k;
          for (int entry = rows.starts[i]; entry < rows.starts[i + 1]; ++entry)
            if (rows.columns[entry] <= i)
              {
                r[k] = rows.columns[entry];
                x[k] = rows.values[entry];
                ++k;
              }
        }
      p[n] = k;
      return upper;
    }



    void
    require(const cholmod_common &common)
    {
      if (common.status < CHOLMOD_OK)
        throw NumericalError("CHOLMOD failed with status " +
                             std::to_string(common.status) +
                             (common.status == CHOLMOD_OUT_OF_MEMORY
                                ? ": the factor does not fit into memory."
                                : "."));
    }
  } // namespace



  std::shared_ptr<const Cholesky::Analysis>
  Cholesky::analyse(cholmod_sparse *upper)
  {
    auto            analysis = std::make_shared<Analysis>();
    cholmod_common &common   = analysis->common;
    // CHOLMOD's own choice, approximate minimum degree, is the quickest to
    // find; on larger matrices nested dissection leaves a smaller factor
    // (measured: doc/contact_solvers.md).
    constexpr unsigned int large = 300000;
    if (upper->nrow > large)
      {
        common.nmethods           = 1;
        common.method[0].ordering = CHOLMOD_NESDIS;
      }
    analysis->pattern = cholmod_analyze(upper, &common);
    require(common);
    return analysis;
  }



  void
  Cholesky::require_one_process(const MPI_Comm communicator)
  {
    if (Utilities::MPI::n_mpi_processes(communicator) > 1)
      throw SceneError(
        "[Linear solver] Type = cholesky works on one process only. Start the "
        "program without mpirun, or choose automatic, mumps, amg or gmg.");
  }



  Cholesky::Cholesky(const Matrix                   &matrix,
                     std::shared_ptr<const Analysis> same_pattern)
    : shared_analysis(std::move(same_pattern))
    , factor(std::make_unique<Factor>())
  {
    require_one_process(matrix.get_mpi_communicator());

    cholmod_common &common = factor->common;
    const auto      free   = [&common](cholmod_sparse *sparse) {
      cholmod_free_sparse(&sparse, &common);
    };
    const std::unique_ptr<cholmod_sparse, decltype(free)> upper(
      copy_for_cholmod(matrix, common), free);
    if (shared_analysis == nullptr)
      shared_analysis = analyse(upper.get());
    factor->L = cholmod_copy_factor(shared_analysis->pattern, &common);
    require(common);
    cholmod_factorize(upper.get(), factor->L, &common);
    require(common);
    if (common.status == CHOLMOD_NOT_POSDEF)
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
    std::ostringstream text;
    text << "sparse Cholesky (CHOLMOD), "
         << (factor->L->is_super != 0 ? "supernodal" : "simplicial") << ", "
         << shared_analysis->common.lnz << " entries in the factor";
    return text.str();
  }



  void
  Cholesky::back_solve(double            *solutions,
                       const double      *right_hand_sides,
                       const unsigned int n_columns)
  {
    factor->solve(solutions, right_hand_sides, n_columns);
  }
} // namespace Crevasse
