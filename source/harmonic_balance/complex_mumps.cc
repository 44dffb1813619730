// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/collectively.h>
#include <crevasse/base/problems.h>
#include <crevasse/base/text.h>
#include <crevasse/harmonic_balance/complex_mumps.h>
#include <crevasse/linear/matrix_operator.h>

#include <algorithm>

namespace Crevasse
{
  using namespace dealii;

  namespace
  {
    /** Computes y = (A' + iA'') x in real and imaginary parts. Collective.
     *
     * @param[out] y_real @p y_imaginary with the layout of the rows. */
    void
    complex_product(const ComplexMumps::Matrix &real,
                    const ComplexMumps::Matrix &imaginary,
                    const Vector               &x_real,
                    const Vector               &x_imaginary,
                    Vector                     &y_real,
                    Vector                     &y_imaginary)
    {
      Vector product(y_real);
      multiply(real, y_real, x_real);
      multiply(imaginary, product, x_imaginary);
      y_real -= product;
      multiply(real, y_imaginary, x_imaginary);
      multiply(imaginary, product, x_real);
      y_imaginary += product;
    }
  } // namespace



  ComplexMumps::ComplexMumps(
    const Matrix                               &real,
    const Matrix                               &imaginary,
    const std::vector<types::global_dof_index> &condensed,
    std::shared_ptr<const Ordering>             same_pattern)
    : MumpsInstance<Complex>(
        real.get_mpi_communicator(),
        real.local_size(),
        condensed,
        "a complex stiffness",
        "Lower [Linear solver] Memory for instants, use more ranks, or use "
        "[Periodic state] Method = march, which needs no complex factors.",
        "Use [Periodic state] Method = anderson, which needs no complex "
        "factors.")
    , ordering(std::move(same_pattern))
  {
    UpperTriangle<double>       A = upper_triangle(real);
    const UpperTriangle<double> B = upper_triangle(imaginary);
    UpperTriangle<Complex>      sum{std::move(A.rows),
                               std::move(A.columns),
                               {A.values.begin(), A.values.end()}};
    AssertDimension(A.values.size(), B.values.size());
    for (std::size_t k = 0; k < sum.values.size(); ++k)
      sum.values[k].imag(B.values[k]);

    std::vector<int> positions;
    if (ordering != nullptr)
      {
        positions    = *ordering;
        icntl(7)     = 1; // use a given ordering
        data.perm_in = positions.data();
      }
    factorise(sum);
    data.perm_in = nullptr;
    if (!condensed.empty())
      invert();
    if (ordering == nullptr)
      ordering = is_root() ? std::make_shared<Ordering>(data.sym_perm,
                                                        data.sym_perm + data.n)
                           : std::make_shared<Ordering>();
    check(real, imaginary);
  }



  void
  ComplexMumps::invert()
  {
    collectively(communicator, [&]() {
      try
        {
          schur_complement.compute_lu_factorization();
          schur_complement.invert();
        }
      catch (const ExceptionBase &)
        {
          throw NumericalError(
            "The compliance of the lip under a harmonic is singular: check "
            "the moduli of [Material] for extreme contrasts.");
        }
    });
    const std::size_t n = schur_complement.m();
    compliance.reinit(n, n);
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 0; j < n; ++j)
        compliance(i, j) =
          0.5 * (schur_complement(i, j) + schur_complement(j, i));
    schur_complement.reinit(0);
  }



  void
  ComplexMumps::check(const Matrix &real, const Matrix &imaginary)
  {
    constexpr double tolerance = 1e-8;
    Vector one(real.locally_owned_range_indices(), real.get_mpi_communicator());
    Vector zero(one), b_real(one), b_imaginary(one);
    one = 1.;
    complex_product(real, imaginary, one, zero, b_real, b_imaginary);
    Vector x_real(b_real), x_imaginary(b_imaginary);
    solve(x_real, x_imaginary);
    Vector &y_real = one, &y_imaginary = zero; // reuse their memory
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
        Text::from_number(residual / size, 3) +
        ": the stiffness is too ill-conditioned for a direct solver. Check "
        "the moduli of [Material] for extreme contrasts and the mesh for "
        "degenerate cells.");
  }



  void
  ComplexMumps::solve(Vector &real, Vector &imaginary)
  {
    const std::size_t    n = real.locally_owned_size();
    std::vector<Complex> local(n);
    for (std::size_t i = 0; i < n; ++i)
      local[i] = {real.local_element(i), imaginary.local_element(i)};
    std::vector<Complex> all = gather(local.data());
    MumpsInstance<Complex>::solve(all, [&](dealii::Vector<Complex> &on_lip) {
      const dealii::Vector<Complex> right = on_lip;
      compliance.vmult(on_lip, right);
    });
    scatter(all, local.data());
    for (std::size_t i = 0; i < n; ++i)
      {
        real.local_element(i)      = local[i].real();
        imaginary.local_element(i) = local[i].imag();
      }
  }
} // namespace Crevasse
