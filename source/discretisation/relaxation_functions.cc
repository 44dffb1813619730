// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/discretisation/relaxation_functions.h>
#include <crevasse/material/phi_functions.h>

namespace Crevasse
{
  template <int dim>
  RelaxationFunctions<dim>::RelaxationFunctions(
    const MaterialState<dim> &material,
    const double              kappa,
    const std::size_t         n_points)
  {
    for (unsigned int i = 0; i < material.fluidity.size(); ++i)
      {
        const double factor = kappa * material.fractions[i];
        const auto   both =
          combine(*material.fluidity[i],
                  *material.stiffness,
                  n_points,
                  [factor](const VoigtMatrix<dim> &H,
                           const VoigtMatrix<dim> &K) {
                    return decay_functions<dim>(factor * (H * K));
                  });
        phi[0].push_back(
          transform(both, n_points, [](const PhiFunctions<dim> &functions) {
            return functions.first;
          }));
        phi[1].push_back(
          transform(both, n_points, [](const PhiFunctions<dim> &functions) {
            return functions.second;
          }));
      }
  }



  template <int dim>
  std::size_t
  RelaxationFunctions<dim>::memory_consumption() const
  {
    std::size_t bytes = 0;
    for (const std::vector<Matrices> &branches : phi)
      for (const Matrices &matrices : branches)
        bytes += matrices.memory_consumption();
    return bytes;
  }



  template struct RelaxationFunctions<2>;
  template struct RelaxationFunctions<3>;
} // namespace Crevasse
