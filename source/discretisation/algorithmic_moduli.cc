// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/discretisation/algorithmic_moduli.h>
#include <crevasse/material/voigt_matrix.h>

namespace Crevasse
{
  template <int dim>
  AlgorithmicModuli<dim>::AlgorithmicModuli(const MaterialState<dim> &material,
                                            const double              kappa,
                                            const std::size_t         n_points)
    : sum(transform(*material.stiffness,
                    n_points,
                    [&material](const VoigtMatrix<dim> &K) {
                      return material.spring * K;
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
            return w * relaxed_stiffness<dim>(K, kappa * w * H);
          }));
        sum = combine(sum,
                      branches.back(),
                      n_points,
                      [](const VoigtMatrix<dim> &a, const VoigtMatrix<dim> &b) {
                        return a + b;
                      });
      }
  }



  template <int dim>
  std::size_t
  AlgorithmicModuli<dim>::memory_consumption() const
  {
    std::size_t bytes = sum.memory_consumption();
    for (const Matrices &branch : branches)
      bytes += branch.memory_consumption();
    return bytes;
  }



  template struct AlgorithmicModuli<2>;
  template struct AlgorithmicModuli<3>;
} // namespace Crevasse
