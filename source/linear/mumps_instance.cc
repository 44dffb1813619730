// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/problems.h>
#include <crevasse/linear/abandoned_factors.h>
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

    void
    run_mumps(DMUMPS_STRUC_C &data)
    {
      dmumps_c(&data);
    }



    void
    run_mumps(ZMUMPS_STRUC_C &data)
    {
      zmumps_c(&data);
    }



    constexpr int free_everything = -2; // job



    MPI_Datatype
    mpi_type(const double *)
    {
      return MPI_DOUBLE;
    }



    MPI_Datatype
    mpi_type(const Complex *)
    {
      return MPI_CXX_DOUBLE_COMPLEX;
    }



    /** Workspace, or buffers of messages between ranks. */
    bool
    needs_larger_buffers(const int status)
    {
      return status == -8 || status == -9 || status == -14 || status == -17 ||
             status == -20;
    }
  } // namespace



  UpperTriangle<double>
  upper_triangle(const dealii::TrilinosWrappers::SparseMatrix &matrix)
  {
    const Epetra_CrsMatrix &A = matrix.trilinos_matrix();
    UpperTriangle<double>   upper;
    const std::size_t       n_about = (A.NumMyNonzeros() + A.NumMyRows()) / 2;
    upper.rows.reserve(n_about);
    upper.columns.reserve(n_about);
    upper.values.reserve(n_about);
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
                                       const std::string &matrix_name,
                                       const std::string &if_memory_is_short,
                                       const std::string &otherwise)
    : communicator(communicator)
    , n_ranks(dealii::Utilities::MPI::n_mpi_processes(communicator))
    , n_local(n_local)
    , matrix_name(matrix_name)
    , if_memory_is_short(if_memory_is_short)
    , otherwise(otherwise)
    , counts(dealii::Utilities::MPI::gather(communicator, n_local))
    , starts(counts.size(), 0)
  {
    for (unsigned int rank = 1; rank < counts.size(); ++rank)
      starts[rank] = starts[rank - 1] + counts[rank - 1];

    data.par          = 1; // rank 0 works too
    data.sym          = 2; // symmetric
    data.comm_fortran = MPI_Comm_c2f(communicator);
    call(-1);
    data.n = dealii::Utilities::MPI::sum(n_local, communicator);
    for (const int output : {1, 2, 3, 4})
      icntl(output) = 0;
    icntl(6)     = 0;  // no permutation for the sake of pivots,
    icntl(8)     = 0;  // no scaling
    data.cntl[0] = 0.; // and no pivoting
    icntl(7)     = 5;  // METIS
    icntl(18)    = 3;  // each rank gives its own entries
    icntl(28)    = 1;  // ordered on rank 0
  }



  template <typename Number>
  MumpsInstance<Number>::~MumpsInstance()
  {
    if (n_ranks == 1 || std::uncaught_exceptions() == 0)
      call(free_everything);
    else
      abandon_factor([left = data]() mutable {
        left.job = free_everything;
        run_mumps(left);
      });
  }



  template <typename Number>
  int &
  MumpsInstance<Number>::icntl(const unsigned int number)
  {
    return data.icntl[number - 1];
  }



  template <typename Number>
  void
  MumpsInstance<Number>::call(const int job)
  {
    data.job = job;
    run_mumps(data);
  }



  template <typename Number>
  void
  MumpsInstance<Number>::factorise(UpperTriangle<Number> &triangle)
  {
    data.nnz_loc = triangle.values.size();
    data.irn_loc = triangle.rows.data();
    data.jcn_loc = triangle.columns.data();
    data.a_loc   = for_mumps(triangle.values);
    run(1, "the analysis");
    // MUMPS predicts the memory; where it falls short, it wants more.
    constexpr int largest_relaxation = 400; // per cent
    call(2);
    while (needs_larger_buffers(data.infog[0]) &&
           icntl(14) < largest_relaxation)
      {
        icntl(14) = 2 * icntl(14) + 10;
        call(2);
      }
    require("the factorisation");
    // INFO(16): what the factorisation was given on this rank, in 10⁶ bytes,
    // rounded down.
    bytes = std::size_t(1000000) * (data.info[15] + 1);
    // What is no longer there is not looked for either.
    data.irn_loc = data.jcn_loc = nullptr;
    data.a_loc                  = nullptr;
  }



  template <typename Number>
  void
  MumpsInstance<Number>::solve(std::vector<Number> &on_root,
                               const unsigned int   n_columns,
                               const char          *what)
  {
    data.nrhs = n_columns;
    data.lrhs = data.n;
    data.rhs  = for_mumps(on_root);
    run(3, what);
  }



  template <typename Number>
  void
  MumpsInstance<Number>::run(const int job, const char *what)
  {
    call(job);
    require(what);
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
    const bool is_singular = status == -6 || status == -10;
    throw NumericalError(
      std::string("MUMPS failed in ") + what + " of " + matrix_name +
      " with INFOG(1) = " + std::to_string(status) +
      ", INFOG(2) = " + std::to_string(data.infog[1]) +
      (is_memory     ? ": memory is short. " + if_memory_is_short
       : is_singular ? ". It is singular: check the moduli of [Material] and "
                       "the supports of [Boundary]."
                     : ". " + otherwise));
  }



  template <typename Number>
  std::vector<Number>
  MumpsInstance<Number>::gather(const Number      *columns,
                                const unsigned int n_columns) const
  {
    if (n_ranks == 1)
      return std::vector<Number>(columns,
                                 columns + std::size_t(n_local) * n_columns);
    const std::size_t   n = data.n;
    std::vector<Number> all(is_root() ? n * n_columns : 0);
    for (unsigned int k = 0; k < n_columns; ++k)
      {
        const int error = MPI_Gatherv(columns + std::size_t(n_local) * k,
                                      n_local,
                                      mpi_type(columns),
                                      all.data() + (is_root() ? n * k : 0),
                                      counts.data(),
                                      starts.data(),
                                      mpi_type(columns),
                                      0,
                                      communicator);
        AssertThrowMPI(error);
      }
    return all;
  }



  template <typename Number>
  void
  MumpsInstance<Number>::scatter(const std::vector<Number> &on_root,
                                 Number                    *columns,
                                 const unsigned int         n_columns) const
  {
    for (unsigned int k = 0; k < n_columns; ++k)
      {
        const int error =
          MPI_Scatterv(on_root.data() +
                         (is_root() ? std::size_t(data.n) * k : 0),
                       counts.data(),
                       starts.data(),
                       mpi_type(columns),
                       columns + std::size_t(n_local) * k,
                       n_local,
                       mpi_type(columns),
                       0,
                       communicator);
        AssertThrowMPI(error);
      }
  }



  template <typename Number>
  bool
  MumpsInstance<Number>::is_root() const
  {
    return !counts.empty();
  }



  template <typename Number>
  std::size_t
  MumpsInstance<Number>::memory_consumption() const
  {
    return bytes;
  }



  double *
  for_mumps(std::vector<double> &values)
  {
    return values.data();
  }



  ZMUMPS_COMPLEX *
  for_mumps(std::vector<std::complex<double>> &values)
  {
    return reinterpret_cast<ZMUMPS_COMPLEX *>(values.data());
  }



  template class MumpsInstance<double>;
  template class MumpsInstance<Complex>;
} // namespace Crevasse
