// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_discretisation_singular_shapes_h
#define crevasse_discretisation_singular_shapes_h

#include <crevasse/discretisation/singular_functions.h>

#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/fe/mapping.h>
#include <deal.II/lac/la_parallel_vector.h>

#include <vector>

namespace Crevasse
{
  /**
   * Singular functions as shape functions: φ = ψ − I_h ψ, with the conforming
   * nodal interpolation I_h. So they vanish at the nodes (but for hanging
   * ones), where displacements, constraints and the bounds of the lip keep
   * their meaning, and are small away from the tip without being cut off.
   * Where a support holds the boundary, what φ has between the nodes is of the
   * order of the interpolation error.
   */
  class SingularShapes
  {
  public:
    SingularShapes(const SingularFunctions     &functions,
                   const dealii::Mapping<2>    &mapping,
                   const dealii::DoFHandler<2> &dof_handler);

    const SingularFunctions &
    functions() const
    {
      return singular_functions;
    }

    unsigned int
    size() const;

    /** φ_k at the points of a cell or face.
     * @param values with shape function values and quadrature points. */
    void
    values(const unsigned int                 k,
           const dealii::FEValuesBase<2>     &values,
           std::vector<dealii::Tensor<1, 2>> &result) const;

    /** ∂φ_k/∂x.
     * @param values with gradients and quadrature points, none of which is
     * the tip. */
    void
    gradients(const unsigned int                 k,
              const dealii::FEValuesBase<2>     &values,
              std::vector<dealii::Tensor<2, 2>> &result) const;

  private:
    using Vector = dealii::LinearAlgebra::distributed::Vector<double>;

    const SingularFunctions singular_functions;
    std::vector<Vector>     interpolated; ///< I_h ψ, with ghost values
  };
} // namespace Crevasse

#endif
