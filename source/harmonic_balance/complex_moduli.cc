// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/harmonic_balance/complex_moduli.h>

#include <deal.II/lac/full_matrix.h>

namespace Crevasse
{
  using namespace dealii;

  namespace
  {
    using Complex = std::complex<double>;



    /** (I + κ K H)⁻¹ K, for two symmetric matrices, positive semidefinite, and
     * a κ whose real part is not negative: the eigenvalues of the inverted
     * matrix are 1 + κλ with λ ≥ 0, never near zero. It is symmetric, also
     * where K has no 33 row. */
    template <int dim>
    ComplexVoigtMatrix<dim>
    complex_stiffness(const VoigtMatrix<dim> &K,
                      const VoigtMatrix<dim> &H,
                      const Complex           kappa)
    {
      constexpr unsigned int n  = n_stress_components<dim>;
      const VoigtMatrix<dim> KH = K * H;
      FullMatrix<Complex>    matrix(n, n);
      for (unsigned int i = 0; i < n; ++i)
        for (unsigned int j = 0; j < n; ++j)
          matrix(i, j) = (i == j ? 1. : 0.) + kappa * KH[i][j];
      matrix.gauss_jordan();
      ComplexVoigtMatrix<dim> result;
      for (unsigned int i = 0; i < n; ++i)
        for (unsigned int j = 0; j < n; ++j)
          result[i] += matrix(i, j) * K[j];
      return 0.5 * (result + transpose(result));
    }
  } // namespace



  template <int dim>
  ComplexModuli<dim>::ComplexModuli(const MaterialState<dim> &material,
                                    const Complex             kappa,
                                    const std::size_t         n_points)
    : sum(transform(*material.stiffness,
                    n_points,
                    [&material](const VoigtMatrix<dim> &K) {
                      return Complex(material.spring) * K;
                    }))
  {
    for (unsigned int i = 0; i < material.fluidity.size(); ++i)
      {
        const double w = material.fractions[i];
        branches.push_back(combine(
          *material.stiffness,
          *material.fluidity[i],
          n_points,
          [w, kappa](const VoigtMatrix<dim> &K, const VoigtMatrix<dim> &H) {
            return w * complex_stiffness<dim>(K, H, kappa * w);
          }));
        sum = combine(sum,
                      branches.back(),
                      n_points,
                      [](const ComplexVoigtMatrix<dim> &a,
                         const ComplexVoigtMatrix<dim> &b) { return a + b; });
      }
  }



  template <int dim>
  std::optional<Complex>
  common_factor(const ComplexModuli<dim>            &moduli,
                const PointValues<VoigtMatrix<dim>> &stiffness,
                const std::size_t                    n_points,
                const MPI_Comm                       communicator)
  {
    constexpr double rounding = 1e-12;
    Complex          factor   = 0.;
    if (n_points > 0)
      factor = moduli.sum[0][0][0] / stiffness[0][0][0];
    // That of a point of the first rank that has any.
    const unsigned int rank = Utilities::MPI::this_mpi_process(communicator);
    const unsigned int first =
      Utilities::MPI::min(n_points > 0 ? rank : numbers::invalid_unsigned_int,
                          communicator);
    factor = Utilities::MPI::broadcast(communicator, factor, first);

    bool is_common = true;
    for (std::size_t p = 0; p < n_points && is_common; ++p)
      is_common = (moduli.sum[p] - factor * stiffness[p]).norm() <=
                  rounding * stiffness[p].norm() * std::abs(factor);
    if (Utilities::MPI::min(is_common ? 1 : 0, communicator) == 0)
      return {};
    return factor;
  }



#define INSTANTIATE(dim)                                           \
  template struct ComplexModuli<dim>;                              \
  template std::optional<std::complex<double>> common_factor<dim>( \
    const ComplexModuli<dim> &,                                    \
    const PointValues<VoigtMatrix<dim>> &,                         \
    const std::size_t,                                             \
    const MPI_Comm)

  INSTANTIATE(2);
  INSTANTIATE(3);

#undef INSTANTIATE
} // namespace Crevasse
