// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/collectively.h>
#include <crevasse/base/problems.h>
#include <crevasse/base/text.h>
#include <crevasse/harmonic_balance/complex_mumps.h>
#include <crevasse/linear/matrix_operator.h>
#include <crevasse/linear/mumps_instance.h>

#include <deal.II/base/mpi.h>
#include <deal.II/lac/lapack_full_matrix.h>

#include <algorithm>

namespace Crevasse
{
  using namespace dealii;

  namespace
  {
    using Complex = std::complex<double>;

    UpperTriangle<Complex>
    combined(const ComplexMumps::Matrix &real,
             const ComplexMumps::Matrix &imaginary)
    {
      UpperTriangle<double>  A = upper_triangle(real);
      UpperTriangle<double>  B = upper_triangle(imaginary);
      UpperTriangle<Complex> sum;
      AssertThrow(A.values.size() == B.values.size(),
                  ExcMessage("The two parts differ in their pattern."));
      for (std::size_t k = 0; k < A.values.size(); ++k)
        sum.values.emplace_back(A.values[k], B.values[k]);
      sum.rows    = std::move(A.rows);
      sum.columns = std::move(A.columns);
      return sum;
    }



    /** MUMPS and LAPACK count the entries of a dense matrix with ints. */
    void
    require_countable(const std::size_t n_condensed)
    {
      constexpr std::size_t most = 46340; // the root of the largest int
      if (n_condensed > most)
        throw NumericalError(
          "The lip has " + std::to_string(n_condensed) +
          " nodes; a period is solved directly, harmonic by harmonic, for at "
          "most " +
          std::to_string(most) +
          ". Use [Periodic state] Method = anderson or march, or a coarser "
          "mesh at the lip.");
    }
  } // namespace



  struct ComplexMumps::Factor : MumpsInstance<Complex>
  {
    Factor(const Matrix                               &matrix,
           const std::vector<types::global_dof_index> &condensed)
      : MumpsInstance<Complex>(
          matrix.get_mpi_communicator(),
          matrix.local_size(),
          "a complex stiffness",
          "Lower [Linear solver] Memory for instants, use more ranks, or use "
          "[Periodic state] Method = march, which needs no complex factors.",
          "Use [Periodic state] Method = anderson, which needs no complex "
          "factors.")
    {
      for (const auto unknown : condensed)
        last_unknowns.push_back(unknown + 1);
    }

    void
    factorise_and_condense(UpperTriangle<Complex> triangle,
                           const Ordering        *ordering)
    {
      require_countable(last_unknowns.size());
      std::vector<int>     positions;
      std::vector<Complex> complement; // on rank 0
      if (ordering != nullptr)
        {
          positions    = *ordering;
          icntl(7)     = 1; // an ordering that is given
          data.perm_in = positions.data();
        }
      if (!last_unknowns.empty())
        {
          icntl(19)          = 1; // Schur complement on rank 0
          data.size_schur    = last_unknowns.size();
          data.listvar_schur = last_unknowns.data();
          if (is_root())
            complement.resize(last_unknowns.size() * last_unknowns.size());
          data.schur = for_mumps(complement);
        }
      factorise(triangle);
      data.perm_in = nullptr;
      data.schur   = nullptr;
      if (!last_unknowns.empty())
        invert(complement);
    }

    /** Makes the compliance of the Schur complement, for all ranks. */
    void
    invert(const std::vector<Complex> &complement)
    {
      const std::size_t n = last_unknowns.size();
      inverse.reinit(n, n);
      collectively(communicator, [&]() {
        if (!is_root())
          return;
        LAPACKFullMatrix<Complex> matrix(n, n);
        for (std::size_t i = 0; i < n; ++i)
          for (std::size_t j = 0; j < n; ++j)
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
        for (std::size_t i = 0; i < n; ++i)
          for (std::size_t j = 0; j < n; ++j)
            inverse(i, j) = 0.5 * (matrix(i, j) + matrix(j, i));
      });
      // One message for each row: the count of all entries may be no int.
      for (std::size_t i = 0; i < n && n_ranks > 1; ++i)
        {
          const int error = MPI_Bcast(
            &inverse(i, 0), n, MPI_CXX_DOUBLE_COMPLEX, 0, communicator);
          AssertThrowMPI(error);
        }
    }

    /** Solves for the right-hand side that rank 0 has. */
    void
    solve_on_root(std::vector<Complex> &on_root)
    {
      if (last_unknowns.empty())
        {
          solve(on_root);
          return;
        }
      const unsigned int   n = last_unknowns.size();
      std::vector<Complex> reduced(n), on_last(n);
      data.lredrhs = n;
      data.redrhs  = for_mumps(reduced);
      icntl(26)    = 1; // as far as the Schur complement
      solve(on_root, 1, "a condensation");
      for (unsigned int i = 0; i < n && is_root(); ++i)
        for (unsigned int j = 0; j < n; ++j)
          on_last[i] += inverse(i, j) * reduced[j];
      data.redrhs = for_mumps(on_last);
      icntl(26)   = 2; // and back
      solve(on_root);
    }

    std::vector<int>    last_unknowns; ///< P, counted from 1
    FullMatrix<Complex> inverse;       ///< on P
  };



  ComplexMumps::ComplexMumps(
    const Matrix                               &real,
    const Matrix                               &imaginary,
    const std::vector<types::global_dof_index> &condensed,
    std::shared_ptr<const Ordering>             same_pattern)
    : order(std::move(same_pattern))
    , factor(std::make_unique<Factor>(real, condensed))
  {
    factor->factorise_and_condense(combined(real, imaginary), order.get());
    if (order == nullptr)
      {
        const int *positions = factor->data.sym_perm;
        order =
          factor->is_root()
            ? std::make_shared<Ordering>(positions, positions + factor->data.n)
            : std::make_shared<Ordering>();
      }
    check(real, imaginary);
  }



  ComplexMumps::~ComplexMumps() = default;



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



  const FullMatrix<std::complex<double>> &
  ComplexMumps::compliance() const
  {
    return factor->inverse;
  }



  void
  ComplexMumps::solve(Vector &real, Vector &imaginary) const
  {
    const std::size_t    n = real.locally_owned_size();
    std::vector<Complex> local(n);
    for (std::size_t i = 0; i < n; ++i)
      local[i] = {real.local_element(i), imaginary.local_element(i)};
    std::vector<Complex> all = factor->gather(local.data());
    factor->solve_on_root(all);
    factor->scatter(all, local.data());
    for (std::size_t i = 0; i < n; ++i)
      {
        real.local_element(i)      = local[i].real();
        imaginary.local_element(i) = local[i].imag();
      }
  }



  std::size_t
  ComplexMumps::memory_consumption() const
  {
    return factor->memory_consumption();
  }
} // namespace Crevasse
