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

#include <crevasse/material/maxwell_law.h>

#include <deal.II/lac/lapack_full_matrix.h>

#include <algorithm>
#include <limits>

namespace Crevasse
{
  using namespace dealii;

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
  double
  largest_relaxation_rate(const VoigtMatrix<dim> &H, const VoigtMatrix<dim> &K)
  {
    // HK is similar to the symmetric √H K √H: its eigenvalues are real, and
    // small enough for the general eigenvalue solver of LAPACK.
    constexpr unsigned int   n  = n_stress_components<dim>;
    const VoigtMatrix<dim>   HK = H * K;
    LAPACKFullMatrix<double> matrix(n, n);
    for (unsigned int i = 0; i < n; ++i)
      for (unsigned int j = 0; j < n; ++j)
        matrix(i, j) = HK[i][j];
    matrix.compute_eigenvalues();

    double largest = 0.;
    for (unsigned int i = 0; i < n; ++i)
      largest = std::max(largest, matrix.eigenvalue(i).real());
    return largest;
  }



  template <int dim>
  MaxwellLaw<dim>::MaxwellLaw(const MaterialParameters &parameters)
    : K(isotropic_stiffness<dim>(parameters.young_modulus,
                                 parameters.poisson_ratio,
                                 dim == 2 &&
                                   parameters.plane_state == "plane stress"))
    , uniform_tau(0.)
  {
    if (parameters.viscosity == "relaxation time")
      {
        uniform_tau = parameters.relaxation_time;
        H           = isotropic_compliance<dim>(parameters.young_modulus,
                                      parameters.poisson_ratio) /
            uniform_tau;
      }
    else if (parameters.viscosity == "isotropic")
      H = isotropic_compliance<dim>(parameters.viscous_modulus,
                                    parameters.viscous_poisson_ratio);
  }



  template <int dim>
  const VoigtMatrix<dim> &
  MaxwellLaw<dim>::stiffness() const
  {
    return K;
  }



  template <int dim>
  const VoigtMatrix<dim> &
  MaxwellLaw<dim>::fluidity() const
  {
    return H;
  }



  template <int dim>
  double
  MaxwellLaw<dim>::smallest_relaxation_time() const
  {
    const double rate = largest_relaxation_rate<dim>(H, K);
    return rate > 0. ? 1. / rate : std::numeric_limits<double>::infinity();
  }



  template <int dim>
  double
  MaxwellLaw<dim>::uniform_relaxation_time() const
  {
    return uniform_tau;
  }



  template VoigtMatrix<2>
  isotropic_stiffness<2>(const double, const double, const bool);
  template VoigtMatrix<3>
  isotropic_stiffness<3>(const double, const double, const bool);
  template VoigtMatrix<2>
  isotropic_compliance<2>(const double, const double);
  template VoigtMatrix<3>
  isotropic_compliance<3>(const double, const double);
  template double
  largest_relaxation_rate<2>(const VoigtMatrix<2> &, const VoigtMatrix<2> &);
  template double
  largest_relaxation_rate<3>(const VoigtMatrix<3> &, const VoigtMatrix<3> &);
  template class MaxwellLaw<2>;
  template class MaxwellLaw<3>;
} // namespace Crevasse
