// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/material/relaxation_modes.h>

#include <deal.II/lac/lapack_full_matrix.h>

namespace Crevasse
{
  using namespace dealii;

  template <int dim>
  RelaxationModes<dim>::RelaxationModes(const VoigtMatrix<dim> &H,
                                        const VoigtMatrix<dim> &K)
  {
    std::vector<unsigned int> places;
    for (unsigned int i = 0; i < n_stress_components<dim>; ++i)
      if (K[i][i] != 0.)
        places.push_back(i);
    const unsigned int       n = places.size();
    LAPACKFullMatrix<double> fluidity(n), stiffness(n);
    for (unsigned int i = 0; i < n; ++i)
      for (unsigned int j = 0; j < n; ++j)
        {
          fluidity(i, j)  = H[places[i]][places[j]];
          stiffness(i, j) = K[places[i]][places[j]];
        }

    constexpr int               eigenvalues_of_KH = 3; // of LAPACK's dsygv
    std::vector<Vector<double>> columns(n);
    fluidity.compute_generalized_eigenvalues_symmetric(stiffness,
                                                       columns,
                                                       eigenvalues_of_KH);
    // Pressure does not relax in volume-preserving creep: its rate is zero.
    constexpr double rounding = 1e-13;
    const double     largest  = fluidity.eigenvalue(n - 1).real();
    for (unsigned int j = 0; j < n; ++j)
      {
        const double rate = fluidity.eigenvalue(j).real();
        rates[places[j]]  = rate < rounding * largest ? 0. : rate;
        for (unsigned int i = 0; i < n; ++i)
          directions[places[i]][places[j]] = columns[j](i);
      }
  }



  template struct RelaxationModes<2>;
  template struct RelaxationModes<3>;
} // namespace Crevasse
