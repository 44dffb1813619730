// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_discretisation_singular_shapes_h
#define crevasse_discretisation_singular_shapes_h

#include <crevasse/base/vector.h>
#include <crevasse/discretisation/polar_field.h>
#include <crevasse/grid/crack_tip.h>
#include <crevasse/material/plane_elasticity.h>

#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/fe/mapping.h>

#include <limits>

namespace Crevasse
{
  /**
   * A displacement ψ with the singularity of a crack tip, to be added to the
   * finite elements (Strang and Fix 1973, §8.2; the end of §7 of the paper). In
   * each mode there are three: w₁, the field of K; D, which with w₁ spans all
   * displacements with √r whatever Poisson's ratio; w₃, the term with r^{3/2}
   * of Williams' series.
   *
   * They are scaled by a length h, the size of the cells at the tip, and to a
   * jump of 1 there, so that a coefficient is a displacement as those of the
   * nodes are, in any units.
   *
   * On the line behind the tip ψ jumps, and the body must not go on there. So
   * where a crack with two lips ends or turns at the distance R, ψ is
   * multiplied by χ = (1 − r²/R²)³, 0 from R on, which leaves the singularity
   * as it is: (1 − χ) ψ has r^{5/2}.
   */
  struct SingularFunction
  {
    /** ψ and ∂ψ/∂x, in the coordinates of the mesh.
     * @param cell_center of the cell that the point is in. */
    dealii::Tensor<1, 2>
    value(const dealii::Point<2> &point,
          const dealii::Point<2> &cell_center) const;
    dealii::Tensor<2, 2>
    gradient(const dealii::Point<2> &point,
             const dealii::Point<2> &cell_center) const;

    /** Whether this one opens the crack at the tip, so that its coefficient
     * must not be negative. */
    bool
    opens() const
    {
      return mode == CrackMode::opening && stress_intensity > 0.;
    }

    CrackTip   tip;
    CrackMode  mode;
    PolarField field;
    double     radius; ///< R, or infinite: χ = 1

    /** K of a unit coefficient of w₁ (stress √length / length), of others 0. */
    double stress_intensity;
  };

  /** Of all tips; none: they are off. */
  using SingularFunctions = std::vector<SingularFunction>;

  /** The first n of mode I, and of mode II at a tip with two lips.
   *
   * @param n from 1 to 3.
   * @param length h
   * @param radius R */
  SingularFunctions
  make_singular_functions(
    const unsigned int     n,
    const CrackTip        &tip,
    const PlaneElasticity &elasticity,
    const double           length,
    const double           radius = std::numeric_limits<double>::infinity());

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
      return functions.size();
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
    std::vector<Vector> interpolated; ///< I_h ψ, with ghost values
  };
} // namespace Crevasse

#endif
