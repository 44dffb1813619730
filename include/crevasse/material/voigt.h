// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_material_voigt_h
#define crevasse_material_voigt_h

#include <deal.II/base/symmetric_tensor.h>
#include <deal.II/base/tensor.h>

namespace Crevasse
{
  /**
   * Symmetric tensors as vectors. In two dimensions the components are
   * (11, 22, 33, 12): 33 is always stored, because a body creeps in thickness
   * direction also in plane stress (no stress 33) and plane strain (no strain
   * 33). In three dimensions they are (11, 22, 33, 12, 13, 23).
   * Strains have engineering shear components (e_12 = 2 ε_12), so that the
   * product of stress and strain vectors is the work.
   */
  template <int dim>
  constexpr unsigned int n_stress_components = (dim == 2 ? 4 : 6);

  template <int dim, typename Number = double>
  using VoigtVector = dealii::Tensor<1, n_stress_components<dim>, Number>;

  template <int dim, typename Number = double>
  using VoigtMatrix = dealii::Tensor<2, n_stress_components<dim>, Number>;

  /** Index of the component (i,j), 0 ≤ i, j < 3. */
  template <int dim>
  constexpr unsigned int
  voigt_index(const unsigned int i, const unsigned int j)
  {
    // 12, 13, 23 follow the three diagonal components: i + j = 1, 2, 3.
    return i == j ? i : 2 + i + j;
  }

  /** Name of a component in tables: "11", "22", ... */
  template <int dim>
  const char *
  voigt_name(const unsigned int component)
  {
    constexpr const char *names[] = {"11", "22", "33", "12", "13", "23"};
    return names[component];
  }

  /** Strain of a displacement gradient, with engineering shears. */
  template <int dim>
  VoigtVector<dim>
  voigt_strain(const dealii::Tensor<2, dim> &gradient)
  {
    VoigtVector<dim> strain;
    for (unsigned int i = 0; i < dim; ++i)
      for (unsigned int j = 0; j < dim; ++j)
        strain[voigt_index<dim>(i, j)] += gradient[i][j];
    return strain;
  }

  /** Stress as a 3 × 3 tensor; components 13, 23 are zero if dim = 2. */
  template <int dim>
  dealii::SymmetricTensor<2, 3>
  stress_tensor(const VoigtVector<dim> &stress)
  {
    dealii::SymmetricTensor<2, 3> tensor;
    for (unsigned int i = 0; i < 3; ++i)
      for (unsigned int j = i; j < 3; ++j)
        if (i == j || j < dim)
          tensor[i][j] = stress[voigt_index<dim>(i, j)];
    return tensor;
  }
} // namespace Crevasse

#endif
