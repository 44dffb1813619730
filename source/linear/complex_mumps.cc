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

#include <crevasse/linear/complex_mumps.h>
#include <crevasse/linear/complex_product.h>
#include <crevasse/scene/collectively.h>
#include <crevasse/scene/problems.h>
#include <crevasse/scene/text.h>

#include <deal.II/base/mpi.h>
#include <deal.II/lac/lapack_full_matrix.h>

#include <Epetra_CrsMatrix.h>
#include <algorithm>
#include <exception>
#include <zmumps_c.h>

namespace Crevasse
{
  using namespace dealii;

  namespace
  {
    using Complex = std::complex<double>;
    static_assert(sizeof(Complex) == sizeof(ZMUMPS_COMPLEX),
                  "MUMPS has the complex numbers of the language");

    ZMUMPS_COMPLEX *
    for_mumps(std::vector<Complex> &values)
    {
      return reinterpret_cast<ZMUMPS_COMPLEX *>(values.data());
    }



    /** The upper triangle of the rows of this rank, counted from 1. */
    struct UpperTriangle
    {
      UpperTriangle(const ComplexMumps::Matrix &real,
                    const ComplexMumps::Matrix &imaginary)
      {
        const Epetra_CrsMatrix &A = real.trilinos_matrix();
        const Epetra_CrsMatrix &B = imaginary.trilinos_matrix();
        AssertThrow(A.NumMyNonzeros() == B.NumMyNonzeros(),
                    ExcMessage("The two parts differ in their pattern."));
        for (int row = 0; row < A.NumMyRows(); ++row)
          {
            int     n, *local_columns;
            double *a, *b;
            A.ExtractMyRowView(row, n, a, local_columns);
            B.ExtractMyRowView(row, n, b);
            const int i = A.GRID(row);
            for (int k = 0; k < n; ++k)
              if (const int j = A.GCID(local_columns[k]); j >= i)
                {
                  rows.push_back(i + 1);
                  columns.push_back(j + 1);
                  values.emplace_back(a[k], b[k]);
                }
          }
      }

      std::vector<int>     rows, columns;
      std::vector<Complex> values;
    };
  } // namespace



  struct ComplexMumps::Factor
  {
    Factor(const Matrix                               &matrix,
           const std::vector<types::global_dof_index> &condensed)
      : communicator(matrix.get_mpi_communicator())
      , n_ranks(Utilities::MPI::n_mpi_processes(communicator))
      , is_root(Utilities::MPI::this_mpi_process(communicator) == 0)
      , n_local(matrix.local_size())
    {
      for (const auto unknown : condensed)
        last_unknowns.push_back(unknown + 1);
      counts = Utilities::MPI::gather(communicator, n_local);
      starts.assign(counts.size(), 0);
      for (unsigned int rank = 1; rank < counts.size(); ++rank)
        starts[rank] = starts[rank - 1] + counts[rank - 1];

      mumps.par          = 1;  // rank 0 works too
      mumps.sym          = 2;  // symmetric, complex
      mumps.job          = -1; // begins
      mumps.comm_fortran = MPI_Comm_c2f(communicator);
      zmumps_c(&mumps);
      mumps.n = matrix.m();
      for (const int output : {1, 2, 3, 4})
        icntl(output) = 0;
      icntl(6)      = 0;  // no permutation for the sake of pivots,
      icntl(8)      = 0;  // no scaling
      mumps.cntl[0] = 0.; // and no pivoting: see the class
      icntl(18)     = 3;  // each rank gives its own entries
      icntl(28)     = 1;  // ordered on rank 0
    }

    int &
    icntl(const unsigned int number)
    {
      return mumps.icntl[number - 1];
    }

    /** Analyses and factorises. */
    void
    factorise(UpperTriangle triangle, const Ordering *ordering)
    {
      std::vector<int>     positions;
      std::vector<Complex> complement;
      if (ordering != nullptr)
        {
          positions     = *ordering;
          icntl(7)      = 1; // an ordering that is given
          mumps.perm_in = positions.data();
        }
      else
        icntl(7) = 5; // METIS
      if (!last_unknowns.empty())
        {
          icntl(19)           = 1; // Schur complement on rank 0
          mumps.size_schur    = last_unknowns.size();
          mumps.listvar_schur = last_unknowns.data();
          complement.resize(last_unknowns.size() * last_unknowns.size());
          mumps.schur = for_mumps(complement);
        }
      mumps.nnz_loc = triangle.values.size();
      mumps.irn_loc = triangle.rows.data();
      mumps.jcn_loc = triangle.columns.data();
      mumps.a_loc   = for_mumps(triangle.values);
      run(1, "the analysis");
      factorise_in_enough_memory();
      // INFO(16): what the factorisation was given on this rank, in 10⁶ bytes,
      // rounded down.
      bytes = std::size_t(1000000) * (mumps.info[15] + 1);
      // What is no longer there is not looked for either.
      mumps.irn_loc = mumps.jcn_loc = mumps.perm_in = nullptr;
      mumps.a_loc = mumps.schur = nullptr;
      if (!last_unknowns.empty())
        invert(complement);
    }

    /** Workspace, or buffers of messages between ranks. */
    static bool
    needs_larger_buffers(const int status)
    {
      return status == -8 || status == -9 || status == -14 || status == -17 ||
             status == -20;
    }

    /** MUMPS predicts the memory; where it falls short, it wants more. */
    void
    factorise_in_enough_memory()
    {
      constexpr int largest_relaxation = 400; // per cent
      mumps.job                        = 2;
      zmumps_c(&mumps);
      while (needs_larger_buffers(mumps.infog[0]) &&
             icntl(14) < largest_relaxation)
        {
          icntl(14) = 2 * icntl(14) + 10;
          zmumps_c(&mumps);
        }
      require("the factorisation");
    }

    /** Makes the compliance of the Schur complement, for all ranks. */
    void
    invert(const std::vector<Complex> &complement)
    {
      const unsigned int   n = last_unknowns.size();
      std::vector<Complex> entries(n * n);
      collectively(communicator, [&]() {
        if (!is_root)
          return;
        LAPACKFullMatrix<Complex> matrix(n, n);
        for (unsigned int i = 0; i < n; ++i)
          for (unsigned int j = 0; j < n; ++j)
            // MUMPS writes one triangle of a symmetric one.
            matrix(i, j) = complement[std::max(i, j) * n + std::min(i, j)];
        try
          {
            matrix.compute_lu_factorization();
            matrix.invert();
          }
        catch (const ExceptionBase &)
          {
            throw NumericalError(
              "The compliance of the lip under a harmonic is singular: the "
              "stiffness is too ill-conditioned. Check the moduli of "
              "[Material] for extreme contrasts.");
          }
        for (unsigned int i = 0; i < n; ++i)
          for (unsigned int j = 0; j < n; ++j)
            entries[i * n + j] = 0.5 * (matrix(i, j) + matrix(j, i));
      });
      const int error =
        MPI_Bcast(entries.data(), 2 * n * n, MPI_DOUBLE, 0, communicator);
      AssertThrowMPI(error);
      inverse.reinit(n, n);
      inverse.fill(entries.data());
    }

    /** Solves for the right-hand side that rank 0 has. */
    void
    solve(std::vector<Complex> &on_root)
    {
      mumps.nrhs = 1;
      mumps.lrhs = mumps.n;
      mumps.rhs  = for_mumps(on_root);
      if (last_unknowns.empty())
        {
          run(3, "a back-solve");
          return;
        }
      const unsigned int   n = last_unknowns.size();
      std::vector<Complex> reduced(n), on_last(n);
      mumps.lredrhs = n;
      mumps.redrhs  = for_mumps(reduced);
      icntl(26)     = 1; // as far as the Schur complement
      run(3, "a condensation");
      for (unsigned int i = 0; i < n && is_root; ++i)
        for (unsigned int j = 0; j < n; ++j)
          on_last[i] += inverse(i, j) * reduced[j];
      mumps.redrhs = for_mumps(on_last);
      icntl(26)    = 2; // and back
      run(3, "a back-solve");
    }

    void
    run(const int job, const char *what)
    {
      mumps.job = job;
      zmumps_c(&mumps);
      require(what);
    }

    void
    require(const char *what) const
    {
      const int status = mumps.infog[0];
      if (status >= 0)
        return;
      const bool is_memory = needs_larger_buffers(status) || status == -7 ||
                             status == -13 || status == -19;
      const bool is_singular = status == -6 || status == -10;
      throw NumericalError(
        std::string("MUMPS failed in ") + what +
        " of a complex stiffness with INFOG(1) = " + std::to_string(status) +
        ", INFOG(2) = " + std::to_string(mumps.infog[1]) +
        (is_memory     ? ": memory is short. Lower [Linear solver] Memory for "
                         "instants, use more ranks, or use [Periodic state] Method "
                         "= march, which needs no complex factors."
         : is_singular ? ". The stiffness is singular: check the moduli of "
                         "[Material] and the supports of [Boundary]."
                       : ". Use [Periodic state] Method = anderson, which "
                         "needs no complex factors."));
    }

    /** Rank 0 gets all entries of two vectors. */
    std::vector<Complex>
    gather(const Vector &real, const Vector &imaginary) const
    {
      std::vector<Complex> local(n_local), all(is_root ? mumps.n : 0);
      for (int i = 0; i < n_local; ++i)
        local[i] = {real.local_element(i), imaginary.local_element(i)};
      if (n_ranks == 1)
        return local;
      const int error = MPI_Gatherv(local.data(),
                                    n_local,
                                    MPI_CXX_DOUBLE_COMPLEX,
                                    all.data(),
                                    counts.data(),
                                    starts.data(),
                                    MPI_CXX_DOUBLE_COMPLEX,
                                    0,
                                    communicator);
      AssertThrowMPI(error);
      return all;
    }

    void
    scatter(std::vector<Complex> &all, Vector &real, Vector &imaginary) const
    {
      std::vector<Complex> local(n_local);
      const int            error = MPI_Scatterv(all.data(),
                                     counts.data(),
                                     starts.data(),
                                     MPI_CXX_DOUBLE_COMPLEX,
                                     local.data(),
                                     n_local,
                                     MPI_CXX_DOUBLE_COMPLEX,
                                     0,
                                     communicator);
      AssertThrowMPI(error);
      for (int i = 0; i < n_local; ++i)
        {
          real.local_element(i)      = local[i].real();
          imaginary.local_element(i) = local[i].imag();
        }
    }

    void
    end()
    {
      mumps.job = -2;
      zmumps_c(&mumps);
    }

    const MPI_Comm   communicator;
    const int        n_ranks;
    const bool       is_root;
    const int        n_local;
    std::vector<int> counts, starts; ///< of all ranks; rank 0 knows them
    std::vector<int> last_unknowns;  ///< P, counted from 1

    FullMatrix<Complex> inverse; ///< on P
    std::size_t         bytes = 0;
    ZMUMPS_STRUC_C      mumps = {};
  };



  ComplexMumps::ComplexMumps(
    const Matrix                               &real,
    const Matrix                               &imaginary,
    const std::vector<types::global_dof_index> &condensed,
    std::shared_ptr<const Ordering>             same_pattern)
    : order(std::move(same_pattern))
    , factor(std::make_unique<Factor>(real, condensed))
  {
    try
      {
        factor->factorise(UpperTriangle(real, imaginary), order.get());
      }
    catch (const NumericalError &)
      {
        factor->end(); // All ranks are here; no destructor will be called.
        throw;
      }
    if (order == nullptr)
      {
        const int *positions = factor->mumps.sym_perm;
        order =
          factor->is_root
            ? std::make_shared<Ordering>(positions, positions + factor->mumps.n)
            : std::make_shared<Ordering>();
      }
    try
      {
        check(real, imaginary);
      }
    catch (const NumericalError &)
      {
        factor->end();
        throw;
      }
  }



  ComplexMumps::~ComplexMumps()
  {
    // MUMPS frees its factor by communication. While an exception is on its way
    // the other ranks may be elsewhere: then the memory is left alone, and the
    // end of the process frees it.
    if (factor->n_ranks == 1 || std::uncaught_exceptions() == 0)
      factor->end();
  }



  void
  ComplexMumps::check(const Matrix &real, const Matrix &imaginary) const
  {
    constexpr double tolerance = 1e-8;
    Vector one(real.locally_owned_range_indices(), real.get_mpi_communicator());
    Vector zero(one);
    one = 1.;
    Vector b_real(one), b_imaginary(one), x_real, x_imaginary;
    complex_product(real, imaginary, one, zero, b_real, b_imaginary);
    x_real      = b_real;
    x_imaginary = b_imaginary;
    solve(x_real, x_imaginary);
    Vector &y_real = one, &y_imaginary = zero; // no longer needed
    complex_product(real, imaginary, x_real, x_imaginary, y_real, y_imaginary);
    y_real -= b_real;
    y_imaginary -= b_imaginary;
    const double residual =
      std::max(y_real.linfty_norm(), y_imaginary.linfty_norm());
    const double size = real.linfty_norm() + imaginary.linfty_norm();
    if (!(residual <= tolerance * size))
      throw NumericalError(
        "MUMPS has found a factor of a complex stiffness that leaves the "
        "relative residual " +
        Text::from_number(residual / size) +
        ": the stiffness is too ill-conditioned for a direct solver. Check "
        "the moduli of [Material] for extreme contrasts and the mesh for "
        "degenerate cells.");
  }



  std::shared_ptr<const ComplexMumps::Ordering>
  ComplexMumps::ordering() const
  {
    return order;
  }



  const FullMatrix<std::complex<double>> &
  ComplexMumps::compliance() const
  {
    return factor->inverse;
  }



  void
  ComplexMumps::solve(Vector &real, Vector &imaginary) const
  {
    std::vector<Complex> entries = factor->gather(real, imaginary);
    factor->solve(entries);
    factor->scatter(entries, real, imaginary);
  }



  std::size_t
  ComplexMumps::memory_consumption() const
  {
    return factor->bytes;
  }
} // namespace Crevasse
