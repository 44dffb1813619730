// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/problems.h>
#include <crevasse/material/isotropic.h>
#include <crevasse/material/voigt_matrix.h>

#include <deal.II/lac/lapack_full_matrix.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace Crevasse
{
  using namespace dealii;

  namespace
  {
    constexpr unsigned int thickness = 2; // the component 33



    template <int dim>
    bool
    is_in_plane(const VoigtMatrix<dim> &matrix)
    {
      return dim == 2 && matrix[thickness].norm_square() == 0.;
    }



    /** The components that a matrix works on. */
    template <int dim>
    std::vector<unsigned int>
    components(const bool in_plane_only)
    {
      std::vector<unsigned int> all;
      for (unsigned int i = 0; i < n_stress_components<dim>; ++i)
        if (i != thickness || !in_plane_only)
          all.push_back(i);
      return all;
    }



    /** What is rounding of the largest rate is none. */
    RelaxationRates
    extremes(const std::vector<double> &rates)
    {
      constexpr double rounding = 1e-12;
      RelaxationRates  result;
      result.least = std::numeric_limits<double>::infinity();
      for (const double rate : rates)
        result.largest = std::max(result.largest, rate);
      for (const double rate : rates)
        if (rate > rounding * result.largest)
          result.least = std::min(result.least, rate);
        else
          result.all = false;
      return result;
    }
  } // namespace



  template <int dim>
  VoigtMatrix<dim>
  inverse(const VoigtMatrix<dim> &matrix)
  {
    const auto               places = components<dim>(is_in_plane<dim>(matrix));
    const unsigned int       n      = places.size();
    LAPACKFullMatrix<double> full(n, n);
    for (unsigned int i = 0; i < n; ++i)
      for (unsigned int j = 0; j < n; ++j)
        full(i, j) =
          0.5 * (matrix[places[i]][places[j]] + matrix[places[j]][places[i]]);
    try
      {
        // Unlike roots, pivots round nothing in a diagonal matrix.
        full.compute_lu_factorization();
        full.invert();
      }
    catch (const ExceptionBase &)
      {
        throw NumericalError("A matrix of [Material] is singular.");
      }
    VoigtMatrix<dim> result;
    for (unsigned int i = 0; i < n; ++i)
      for (unsigned int j = 0; j < n; ++j)
        result[places[i]][places[j]] = 0.5 * (full(i, j) + full(j, i));
    return result;
  }



  template <int dim>
  VoigtMatrix<dim>
  relaxed_stiffness(const VoigtMatrix<dim> &K, const VoigtMatrix<dim> &H)
  {
    constexpr unsigned int   n  = n_stress_components<dim>;
    const VoigtMatrix<dim>   KH = K * H;
    LAPACKFullMatrix<double> matrix(n, n), columns(n, n);
    for (unsigned int i = 0; i < n; ++i)
      for (unsigned int j = 0; j < n; ++j)
        {
          matrix(i, j)  = (i == j ? 1. : 0.) + KH[i][j];
          columns(i, j) = K[i][j];
        }
    try
      {
        matrix.compute_lu_factorization();
        matrix.solve(columns);
      }
    catch (const ExceptionBase &)
      {
        throw NumericalError(
          "A matrix I + c K H of the implicit time scheme is singular to "
          "rounding: a step is too many relaxation times long. Take shorter "
          "steps or slower flow.");
      }
    VoigtMatrix<dim> result;
    for (unsigned int i = 0; i < n; ++i)
      for (unsigned int j = 0; j < n; ++j)
        result[i][j] = columns(i, j);
    return 0.5 * (result + transpose(result));
  }



  template <int dim>
  VoigtMatrix<dim>
  condense_thickness(const VoigtMatrix<dim> &matrix)
  {
    VoigtMatrix<dim> result;
    for (unsigned int i = 0; i < n_stress_components<dim>; ++i)
      for (unsigned int j = 0; j < n_stress_components<dim>; ++j)
        if (i != thickness && j != thickness)
          result[i][j] = matrix[i][j] - matrix[i][thickness] *
                                          matrix[thickness][j] /
                                          matrix[thickness][thickness];
    return result;
  }



  template <int dim>
  VoigtMatrix<dim>
  in_plane(const VoigtMatrix<dim> &matrix)
  {
    VoigtMatrix<dim> result = matrix;
    for (unsigned int i = 0; i < n_stress_components<dim>; ++i)
      result[i][thickness] = result[thickness][i] = 0.;
    return result;
  }



  template <int dim>
  double
  least_relative_eigenvalue(const VoigtMatrix<dim> &matrix,
                            const bool              in_plane_only)
  {
    const auto               places  = components<dim>(in_plane_only);
    const unsigned int       n       = places.size();
    double                   largest = 0.;
    LAPACKFullMatrix<double> full(n, n);
    for (unsigned int i = 0; i < n; ++i)
      for (unsigned int j = 0; j < n; ++j)
        {
          full(i, j) = matrix[places[i]][places[j]];
          largest    = std::max(largest, std::abs(full(i, j)));
        }
    if (!(largest > 0.))
      return 0.;
    full.compute_eigenvalues();
    double least = full.eigenvalue(0).real();
    for (unsigned int i = 1; i < n; ++i)
      least = std::min(least, full.eigenvalue(i).real());
    return least / largest;
  }



  template <int dim>
  RelaxationRates
  relaxation_rates(const VoigtMatrix<dim> &H, const VoigtMatrix<dim> &K)
  {
    if (is_isotropic<dim>(H) && is_isotropic<dim>(K))
      {
        // Both have the same eigenvectors: equal tension in all directions that
        // K knows, and shear.
        const double directions = is_in_plane<dim>(K) ? 2. : 3.;
        const double tension    = (K[0][0] + (directions - 1.) * K[0][1]) *
                               (H[0][0] + (directions - 1.) * H[0][1]);
        return extremes({tension,
                         (K[0][0] - K[0][1]) * (H[0][0] - H[0][1]),
                         K[3][3] * H[3][3]});
      }
    // HK is similar to the symmetric √H K √H: its eigenvalues are real, and
    // small enough for the general eigenvalue solver of LAPACK.
    const auto               places = components<dim>(is_in_plane<dim>(K));
    const unsigned int       n      = places.size();
    const VoigtMatrix<dim>   HK     = H * K;
    LAPACKFullMatrix<double> matrix(n, n);
    for (unsigned int i = 0; i < n; ++i)
      for (unsigned int j = 0; j < n; ++j)
        matrix(i, j) = HK[places[i]][places[j]];
    matrix.compute_eigenvalues();
    std::vector<double> rates;
    for (unsigned int i = 0; i < n; ++i)
      rates.push_back(matrix.eigenvalue(i).real());
    return extremes(rates);
  }



#define INSTANTIATE(dim)                                                       \
  template VoigtMatrix<dim> inverse<dim>(const VoigtMatrix<dim> &);            \
  template VoigtMatrix<dim> relaxed_stiffness<dim>(const VoigtMatrix<dim> &,   \
                                                   const VoigtMatrix<dim> &);  \
  template VoigtMatrix<dim> condense_thickness<dim>(const VoigtMatrix<dim> &); \
  template VoigtMatrix<dim> in_plane<dim>(const VoigtMatrix<dim> &);           \
  template double least_relative_eigenvalue<dim>(const VoigtMatrix<dim> &,     \
                                                 const bool);                  \
  template RelaxationRates relaxation_rates<dim>(const VoigtMatrix<dim> &,     \
                                                 const VoigtMatrix<dim> &)

  INSTANTIATE(2);
  INSTANTIATE(3);

#undef INSTANTIATE
} // namespace Crevasse
