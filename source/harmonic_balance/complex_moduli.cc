// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/harmonic_balance/complex_moduli.h>

#include <deal.II/base/mpi.h>

namespace Crevasse
{
  using namespace dealii;

  namespace
  {
    template <int dim>
    ComplexVoigtMatrix<dim>
    multiple(const std::complex<double> factor, const VoigtMatrix<dim> &matrix)
    {
      ComplexVoigtMatrix<dim> result;
      for (unsigned int i = 0; i < n_stress_components<dim>; ++i)
        for (unsigned int j = 0; j < n_stress_components<dim>; ++j)
          result[i][j] = factor * matrix[i][j];
      return result;
    }



    template <int dim, typename Part>
    PointValues<VoigtMatrix<dim>>
    parts(const PointValues<ComplexVoigtMatrix<dim>> &matrices,
          const std::size_t                           n_points,
          const Part                                 &part)
    {
      return transform(
        matrices, n_points, [&](const ComplexVoigtMatrix<dim> &matrix) {
          VoigtMatrix<dim> result;
          for (unsigned int i = 0; i < n_stress_components<dim>; ++i)
            for (unsigned int j = 0; j < n_stress_components<dim>; ++j)
              result[i][j] = part(matrix[i][j]);
          return result;
        });
    }
  } // namespace



  template <int dim>
  ComplexModuli<dim>::ComplexModuli(const MaterialState<dim>  &material,
                                    const std::complex<double> kappa,
                                    const std::size_t          n_points)
    : sum(transform(*material.stiffness,
                    n_points,
                    [&material](const VoigtMatrix<dim> &K) {
                      return multiple<dim>(material.spring, K);
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
  std::optional<std::complex<double>>
  common_factor(const ComplexModuli<dim>            &moduli,
                const PointValues<VoigtMatrix<dim>> &stiffness,
                const std::size_t                    n_points,
                const MPI_Comm                       communicator)
  {
    constexpr double     rounding = 1e-12;
    std::complex<double> factor   = 0.;
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
      is_common =
        (moduli.sum[p] - multiple<dim>(factor, stiffness[p])).norm() <=
        rounding * stiffness[p].norm() * std::abs(factor);
    if (Utilities::MPI::min(is_common ? 1 : 0, communicator) == 0)
      return {};
    return factor;
  }



  template <int dim>
  PointValues<VoigtMatrix<dim>>
  real_parts(const PointValues<ComplexVoigtMatrix<dim>> &matrices,
             const std::size_t                           n_points)
  {
    return parts<dim>(matrices, n_points, [](const std::complex<double> z) {
      return z.real();
    });
  }



  template <int dim>
  PointValues<VoigtMatrix<dim>>
  imaginary_parts(const PointValues<ComplexVoigtMatrix<dim>> &matrices,
                  const std::size_t                           n_points)
  {
    return parts<dim>(matrices, n_points, [](const std::complex<double> z) {
      return z.imag();
    });
  }



#define INSTANTIATE(dim)                                              \
  template struct ComplexModuli<dim>;                                 \
  template std::optional<std::complex<double>> common_factor<dim>(    \
    const ComplexModuli<dim> &,                                       \
    const PointValues<VoigtMatrix<dim>> &,                            \
    const std::size_t,                                                \
    const MPI_Comm);                                                  \
  template PointValues<VoigtMatrix<dim>> real_parts<dim>(             \
    const PointValues<ComplexVoigtMatrix<dim>> &, const std::size_t); \
  template PointValues<VoigtMatrix<dim>> imaginary_parts<dim>(        \
    const PointValues<ComplexVoigtMatrix<dim>> &, const std::size_t)

  INSTANTIATE(2);
  INSTANTIATE(3);

#undef INSTANTIATE
} // namespace Crevasse
