// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/problems.h>
#include <crevasse/material/relaxation_modes.h>
#include <crevasse/material/voigt_matrix.h>

#include <deal.II/lac/full_matrix.h>
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



    template <int dim>
    LAPACKFullMatrix<double>
    to_lapack(const VoigtMatrix<dim>          &matrix,
              const std::vector<unsigned int> &places)
    {
      LAPACKFullMatrix<double> full(places.size());
      for (unsigned int i = 0; i < places.size(); ++i)
        for (unsigned int j = 0; j < places.size(); ++j)
          full(i, j) = matrix[places[i]][places[j]];
      return full;
    }



    /** The symmetric part of a matrix that LAPACK returns. */
    template <int dim>
    VoigtMatrix<dim>
    symmetric_part(const LAPACKFullMatrix<double>  &full,
                   const std::vector<unsigned int> &places)
    {
      VoigtMatrix<dim> result;
      for (unsigned int i = 0; i < places.size(); ++i)
        for (unsigned int j = 0; j < places.size(); ++j)
          result[places[i]][places[j]] = 0.5 * (full(i, j) + full(j, i));
      return result;
    }



    /** Real eigenvalues of a matrix, in the plane or all. */
    template <int dim>
    std::vector<double>
    eigenvalues(const VoigtMatrix<dim> &matrix, const bool in_plane_only)
    {
      LAPACKFullMatrix<double> full =
        to_lapack<dim>(matrix, components<dim>(in_plane_only));
      full.compute_eigenvalues();
      std::vector<double> values;
      for (unsigned int i = 0; i < full.m(); ++i)
        values.push_back(full.eigenvalue(i).real());
      return values;
    }



    /** Extremes of rates, without those that are rounding of the largest. */
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
    LAPACKFullMatrix<double> full =
      to_lapack<dim>(0.5 * (matrix + transpose(matrix)), places);
    try
      {
        // Unlike roots, pivots round nothing in a diagonal matrix.
        full.compute_lu_factorization();
        full.invert();
      }
    catch (const ExceptionBase &)
      {
        throw NumericalError(
          "A matrix of [Material] is singular. Check its entries and their "
          "order.");
      }
    return symmetric_part<dim>(full, places);
  }



  template <int dim>
  VoigtMatrix<dim>
  relaxed_stiffness(const VoigtMatrix<dim> &K,
                    const VoigtMatrix<dim> &H,
                    const double            kappa)
  {
    const auto       places     = components<dim>(false);
    VoigtMatrix<dim> relaxation = K * (kappa * H);
    for (const unsigned int i : places)
      relaxation[i][i] += 1.;
    LAPACKFullMatrix<double> matrix  = to_lapack<dim>(relaxation, places);
    LAPACKFullMatrix<double> columns = to_lapack<dim>(K, places);
    try
      {
        matrix.compute_lu_factorization();
        matrix.solve(columns);
      }
    catch (const ExceptionBase &)
      {
        throw NumericalError(
          "A matrix I + c K H of the implicit time scheme is singular to "
          "rounding: the step is too long for the relaxation times. Take "
          "shorter steps.");
      }
    return symmetric_part<dim>(columns, places);
  }



  // The eigenvalues of the inverted matrix are 1 + κλ with λ ≥ 0, never near
  // zero. The result is symmetric, also if row 33 of K is zero.
  template <int dim>
  VoigtMatrix<dim, std::complex<double>>
  relaxed_stiffness(const VoigtMatrix<dim>    &K,
                    const VoigtMatrix<dim>    &H,
                    const std::complex<double> kappa)
  {
    constexpr unsigned int                 n = n_stress_components<dim>;
    VoigtMatrix<dim, std::complex<double>> result;
    if (std::isinf(kappa.real()))
      {
        const RelaxationModes<dim> modes(H, K);
        const auto                &X = modes.directions;
        for (unsigned int m = 0; m < n; ++m)
          for (unsigned int i = 0; i < n && modes.rates[m] == 0.; ++i)
            for (unsigned int j = 0; j < n; ++j)
              result[i][j] += X[i][m] * X[j][m];
        return result;
      }
    const VoigtMatrix<dim>           KH = K * H;
    FullMatrix<std::complex<double>> matrix(n, n);
    for (unsigned int i = 0; i < n; ++i)
      for (unsigned int j = 0; j < n; ++j)
        matrix(i, j) = (i == j ? 1. : 0.) + kappa * KH[i][j];
    matrix.gauss_jordan();
    for (unsigned int i = 0; i < n; ++i)
      for (unsigned int j = 0; j < n; ++j)
        result[i] += matrix(i, j) * K[j];
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
    const auto places  = components<dim>(in_plane_only);
    double     largest = 0.;
    for (const unsigned int i : places)
      for (const unsigned int j : places)
        largest = std::max(largest, std::abs(matrix[i][j]));
    if (!(largest > 0.))
      return 0.;
    const std::vector<double> values = eigenvalues<dim>(matrix, in_plane_only);
    return *std::min_element(values.begin(), values.end()) / largest;
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
    return extremes(eigenvalues<dim>(H * K, is_in_plane<dim>(K)));
  }



  template <int dim>
  VoigtMatrix<dim>
  isotropic_stiffness(const double young_modulus,
                      const double poisson_ratio,
                      const bool   plane_stress)
  {
    const double E = young_modulus, nu = poisson_ratio;
    const double mu = E / (2. * (1. + nu));
    const double lambda =
      plane_stress ? E * nu / (1. - nu * nu) : 2. * mu * nu / (1. - 2. * nu);

    VoigtMatrix<dim>   K;
    const unsigned int n_normal = plane_stress ? 2 : 3;
    for (unsigned int i = 0; i < n_normal; ++i)
      for (unsigned int j = 0; j < n_normal; ++j)
        K[i][j] = lambda + (i == j ? 2. * mu : 0.);
    for (unsigned int i = 3; i < n_stress_components<dim>; ++i)
      K[i][i] = mu;
    return K;
  }



  template <int dim>
  VoigtMatrix<dim>
  isotropic_compliance(const double young_modulus, const double poisson_ratio)
  {
    VoigtMatrix<dim> compliance;
    for (unsigned int i = 0; i < 3; ++i)
      for (unsigned int j = 0; j < 3; ++j)
        compliance[i][j] = (i == j ? 1. : -poisson_ratio) / young_modulus;
    for (unsigned int i = 3; i < n_stress_components<dim>; ++i)
      compliance[i][i] = 2. * (1. + poisson_ratio) / young_modulus;
    return compliance;
  }



  template <int dim>
  bool
  is_isotropic(const VoigtMatrix<dim> &matrix)
  {
    const double rounding = 1e-14 * std::abs(matrix[0][0]);
    const auto   equal    = [rounding](const double a, const double b) {
      return std::abs(a - b) <= rounding;
    };
    const bool is_plane_stress  = dim == 2 && matrix[2].norm_square() == 0.;
    const unsigned int n_normal = is_plane_stress ? 2 : 3;
    const double       shear    = matrix[3][3];
    for (unsigned int i = 0; i < n_stress_components<dim>; ++i)
      for (unsigned int j = 0; j < n_stress_components<dim>; ++j)
        {
          const bool   normal = i < n_normal && j < n_normal;
          const bool   absent = is_plane_stress && (i == 2 || j == 2);
          const double expected =
            absent ? 0.
                   : (normal ? (i == j ? matrix[0][0] : matrix[0][1])
                             : (i == j ? shear : 0.));
          if (!equal(matrix[i][j], expected))
            return false;
        }
    return true;
  }



  template <int dim>
  PhiFunctions<dim>
  decay_functions(const VoigtMatrix<dim> &rate)
  {
    const double size = rate.norm();
    if (!std::isfinite(size))
      throw NumericalError(
        "The relaxation of a material over a step is not finite: the step is "
        "too long for the relaxation times. Take shorter steps.");
    // Below ½ the series has all its digits after 14 terms.
    int doublings = 0;
    if (size > 0.5)
      doublings = std::ilogb(size) + 2;
    const VoigtMatrix<dim> z = -std::ldexp(1., -doublings) * rate;

    VoigtMatrix<dim> identity;
    for (unsigned int i = 0; i < n_stress_components<dim>; ++i)
      identity[i][i] = 1.;

    // φ₂ = Σ zⁿ/(n+2)!, by Horner's rule.
    constexpr unsigned int terms = 14;
    PhiFunctions<dim>      phi;
    for (unsigned int n = terms; n > 0; --n)
      phi.second = (identity + z * phi.second) / (n + 1.);
    phi.first                    = identity + z * phi.second;
    VoigtMatrix<dim> exponential = identity + z * phi.first;

    for (int n = 0; n < doublings; ++n)
      {
        phi.second = 0.25 * (exponential * phi.second + phi.first + phi.second);
        phi.first  = 0.5 * (exponential * phi.first + phi.first);
        exponential = exponential * exponential;
      }
    return phi;
  }



#define INSTANTIATE(dim)                                                       \
  template decltype(inverse<dim>) inverse<dim>;                                \
  template VoigtMatrix<dim> relaxed_stiffness<dim>(const VoigtMatrix<dim> &,   \
                                                   const VoigtMatrix<dim> &,   \
                                                   const double);              \
  template VoigtMatrix<dim, std::complex<double>> relaxed_stiffness<dim>(      \
    const VoigtMatrix<dim> &,                                                  \
    const VoigtMatrix<dim> &,                                                  \
    const std::complex<double>);                                               \
  template decltype(condense_thickness<dim>) condense_thickness<dim>;          \
  template decltype(in_plane<dim>)           in_plane<dim>;                    \
  template decltype(least_relative_eigenvalue<dim>)                            \
                                               least_relative_eigenvalue<dim>; \
  template decltype(relaxation_rates<dim>)     relaxation_rates<dim>;          \
  template decltype(isotropic_stiffness<dim>)  isotropic_stiffness<dim>;       \
  template decltype(isotropic_compliance<dim>) isotropic_compliance<dim>;      \
  template decltype(is_isotropic<dim>)         is_isotropic<dim>;              \
  template decltype(decay_functions<dim>)      decay_functions<dim>

  INSTANTIATE(2);
  INSTANTIATE(3);

#undef INSTANTIATE
} // namespace Crevasse
