// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_discretisation_singular_shapes_h
#define crevasse_discretisation_singular_shapes_h

#include <crevasse/discretisation/crack_tip.h>
#include <crevasse/discretisation/polar_field.h>
#include <crevasse/material/plane_elasticity.h>

#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/fe/mapping.h>
#include <deal.II/lac/la_parallel_vector.h>


namespace Crevasse
{
  /**
   * Displacements ψ of mode I with the singularities of a crack tip, to be
   * added to the finite elements (Strang and Fix 1973, §8.2; the end of §7 of
   * the paper): w₁, the field of K_I; D, which with w₁ spans all displacements
   * with √r whatever Poisson's ratio; w₃, the term with r^{3/2} of Williams'
   * series.
   *
   * They are scaled by a length h, the size of the cells at the tip, and to an
   * opening of 1 there, so that a coefficient is a displacement as those of the
   * nodes are, in any units.
   */
  struct SingularFunctions
  {
    /** ψ_k and ∂ψ_k/∂x, in the coordinates of the mesh. */
    dealii::Tensor<1, 2>
    value(const unsigned int k, const dealii::Point<2> &point) const
    {
      return tip.global(fields[k].displacement(tip.local(point)));
    }
    dealii::Tensor<2, 2>
    gradient(const unsigned int k, const dealii::Point<2> &point) const
    {
      const dealii::Tensor<2, 2> to_local = tip.to_local();
      return transpose(to_local) * fields[k].gradient(tip.local(point)) *
             to_local;
    }

    CrackTip                tip;
    std::vector<PolarField> fields; ///< none: they are off

    /** K_I of a unit coefficient of w₁ (stress √length / length). */
    double unit_stress_intensity = 0.;
  };

  /** @param n from 1 to 3.
   * @param length h */
  SingularFunctions
  make_singular_functions(const unsigned int     n,
                          const CrackTip        &tip,
                          const PlaneElasticity &elasticity,
                          const double           length);

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

    const SingularFunctions functions;

    unsigned int
    size() const
    {
      return functions.fields.size();
    }

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

    std::vector<Vector> interpolated; ///< I_h ψ, with ghost values
  };
} // namespace Crevasse

#endif
