// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/collectively.h>
#include <crevasse/base/problems.h>
#include <crevasse/linear/mumps_instance.h>

#include <deal.II/base/mpi.h>

#include <Epetra_CrsMatrix.h>
#include <exception>

namespace Crevasse
{
  namespace
  {
    using Complex = std::complex<double>;
    static_assert(sizeof(Complex) == sizeof(ZMUMPS_COMPLEX),
                  "MUMPS has the complex numbers of the language");

    constexpr int free_everything = -2; // job

    /** Abandoned factors, in the same order on all ranks. */
    std::vector<std::function<void()>> abandoned;



    /** Whether MUMPS' status asks for more workspace or message buffers. */
    bool
    needs_larger_buffers(const int status)
    {
      return status == -8 || status == -9 || status == -14 || status == -17 ||
             status == -20;
    }
  } // namespace



  void
  end_abandoned_factors()
  {
    for (const std::function<void()> &end : std::exchange(abandoned, {}))
      end();
  }



  UpperTriangle<double>
  upper_triangle(const dealii::TrilinosWrappers::SparseMatrix &matrix)
  {
    const Epetra_CrsMatrix &A = matrix.trilinos_matrix();
    UpperTriangle<double>   upper;
    for (int row = 0; row < A.NumMyRows(); ++row)
      {
        int     n, *local_columns;
        double *values;
        A.ExtractMyRowView(row, n, values, local_columns);
        const int i = A.GRID(row);
        for (int k = 0; k < n; ++k)
          if (const int j = A.GCID(local_columns[k]); j >= i)
            {
              upper.rows.push_back(i + 1);
              upper.columns.push_back(j + 1);
              upper.values.push_back(values[k]);
            }
      }
    return upper;
  }



  template <typename Number>
  MumpsInstance<Number>::MumpsInstance(const MPI_Comm     communicator,
                                       const int          n_local,
                                       const Indices     &last,
                                       const std::string &matrix_name,
                                       const std::string &if_memory_is_short,
                                       const std::string &otherwise)
    : communicator(communicator)
    , n_ranks(dealii::Utilities::MPI::n_mpi_processes(communicator))
    , n_local(n_local)
    , last(last.begin(), last.end())
    , matrix_name(matrix_name)
    , if_memory_is_short(if_memory_is_short)
    , otherwise(otherwise)
    , counts(dealii::Utilities::MPI::gather(communicator, n_local))
    , starts(counts.size(), 0)
  {
    for (int &unknown : this->last)
      ++unknown;
    for (unsigned int rank = 1; rank < counts.size(); ++rank)
      starts[rank] = starts[rank - 1] + counts[rank - 1];

    data.par          = 1; // rank 0 works too
    data.sym          = 2; // symmetric
    data.comm_fortran = MPI_Comm_c2f(communicator);
    call(data, -1);
    data.n = dealii::Utilities::MPI::sum(n_local, communicator);
    for (const int output : {1, 2, 3, 4})
      icntl(output) = 0;
    icntl(6)     = 0;  // no permutation for pivots,
    icntl(8)     = 0;  // no scaling
    data.cntl[0] = 0.; // and no pivoting
    icntl(7)     = 5;  // METIS
    icntl(18)    = 3;  // distributed entries
    icntl(28)    = 1;  // ordering on rank 0
  }



  template <typename Number>
  MumpsInstance<Number>::~MumpsInstance()
  {
    if (n_ranks == 1 || std::uncaught_exceptions() == 0)
      call(data, free_everything);
    else
      abandoned.emplace_back(
        [left = data]() mutable { call(left, free_everything); });
  }



  template <typename Number>
  void
  MumpsInstance<Number>::call(Data &data, const int job)
  {
    data.job = job;
    if constexpr (std::is_same<Number, double>::value)
      dmumps_c(&data);
    else
      zmumps_c(&data);
  }



  template <typename Number>
  void
  MumpsInstance<Number>::factorise(UpperTriangle<Number> &triangle)
  {
    data.nnz_loc = triangle.values.size();
    data.irn_loc = triangle.rows.data();
    data.jcn_loc = triangle.columns.data();
    data.a_loc   = for_mumps(triangle.values);
    if (!last.empty())
      {
        // MUMPS does not eliminate P, and writes its Schur complement here.
        schur_complement.reinit(last.size());
        icntl(19)          = 1; // on rank 0
        data.size_schur    = last.size();
        data.listvar_schur = last.data();
        data.schur =
          reinterpret_cast<decltype(data.schur)>(&schur_complement(0, 0));
      }
    call(data, 1);
    require("the analysis");
    // MUMPS predicts the memory; if that is too small, increase it.
    constexpr int largest_relaxation = 400; // per cent
    call(data, 2);
    while (needs_larger_buffers(data.infog[0]) &&
           icntl(14) < largest_relaxation)
      {
        icntl(14) = 2 * icntl(14) + 10;
        call(data, 2);
      }
    require("the factorisation");
    // INFO(16): memory of the factorisation on this rank, in 10⁶ bytes, rounded
    // down.
    bytes = std::size_t(1000000) * (data.info[15] + 1);
    // Clear pointers to arrays that MUMPS must not read any more.
    data.irn_loc = data.jcn_loc = nullptr;
    data.a_loc                  = nullptr;
    data.schur                  = nullptr;
    if (last.empty())
      return;
    // MUMPS writes one triangle of the Schur complement, on the first rank.
    const std::size_t n = last.size();
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 0; j < i; ++j)
        schur_complement(i, j) = schur_complement(j, i);
    dealii::Utilities::MPI::broadcast(&schur_complement(0, 0),
                                      n * n,
                                      0,
                                      communicator);
  }



  template <typename Number>
  void
  MumpsInstance<Number>::solve(std::vector<Number> &on_root,
                               const Problem       &problem)
  {
    data.nrhs = 1;
    data.lrhs = data.n;
    data.rhs  = for_mumps(on_root);
    if (last.empty())
      {
        call(data, 3);
        require("a back-solve");
        return;
      }
    dealii::Vector<Number> on_last(last.size());
    data.lredrhs = on_last.size();
    data.redrhs  = reinterpret_cast<decltype(data.redrhs)>(on_last.begin());
    icntl(26)    = 1; // forward to P
    call(data, 3);
    require("a condensation");
    dealii::Utilities::MPI::broadcast(on_last.begin(),
                                      on_last.size(),
                                      0,
                                      communicator);
    collectively(communicator, [&]() { problem(on_last); });
    // The problem may have put its solution elsewhere.
    data.redrhs = reinterpret_cast<decltype(data.redrhs)>(on_last.begin());
    icntl(26)   = 2; // and backward
    call(data, 3);
    require("a back-solve");
  }



  template <typename Number>
  void
  MumpsInstance<Number>::require(const char *what) const
  {
    const int status = data.infog[0];
    if (status >= 0)
      return;
    const bool is_memory = needs_larger_buffers(status) || status == -7 ||
                           status == -13 || status == -19;
    throw NumericalError(std::string("MUMPS failed in ") + what + " of " +
                         matrix_name +
                         " with INFOG(1) = " + std::to_string(status) +
                         ", INFOG(2) = " + std::to_string(data.infog[1]) +
                         (is_memory ? ": memory is short. " + if_memory_is_short
                                    : ". " + otherwise));
  }



  template <typename Number>
  std::vector<Number>
  MumpsInstance<Number>::gather(const Number *local) const
  {
    const MPI_Datatype type =
      dealii::Utilities::MPI::mpi_type_id_for_type<Number>;
    std::vector<Number> all(is_root() ? data.n : 0);
    const int           error = MPI_Gatherv(local,
                                  n_local,
                                  type,
                                  all.data(),
                                  counts.data(),
                                  starts.data(),
                                  type,
                                  0,
                                  communicator);
    AssertThrowMPI(error);
    return all;
  }



  template <typename Number>
  void
  MumpsInstance<Number>::scatter(const std::vector<Number> &on_root,
                                 Number                    *local) const
  {
    const MPI_Datatype type =
      dealii::Utilities::MPI::mpi_type_id_for_type<Number>;
    const int error = MPI_Scatterv(on_root.data(),
                                   counts.data(),
                                   starts.data(),
                                   type,
                                   local,
                                   n_local,
                                   type,
                                   0,
                                   communicator);
    AssertThrowMPI(error);
  }



  template class MumpsInstance<double>;
  template class MumpsInstance<Complex>;
} // namespace Crevasse
