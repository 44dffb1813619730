// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_discretisation_singular_shapes_h
#define crevasse_discretisation_singular_shapes_h

#include <crevasse/base/vector.h>
#include <crevasse/discretisation/polar_field.h>
#include <crevasse/grid/crack_tip.h>
#include <crevasse/material/plane_elasticity.h>

#include <deal.II/base/quadrature.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/fe/mapping.h>

#include <limits>
#include <optional>

namespace Crevasse
{
  /**
   * A displacement ψ with the singularity of a crack tip, added to the finite
   * elements (Strang and Fix 1973, §8.2; the end of §7 of the paper). Each mode
   * has three: w₁, the field of K; D, which with w₁ spans all displacements
   * with √r for any Poisson's ratio; w₃, the term with r^{3/2} of Williams'
   * series.
   *
   * ψ is scaled by a length h, the size of the cells at the tip, and to a jump
   * of 1 there, so that a coefficient is a displacement like nodal values, in
   * any units.
   *
   * On the line behind the tip ψ jumps, so that the body must not continue
   * there. Where a crack with two lips ends or turns at the distance R, ψ is
   * multiplied by χ = (1 − r²/R²)³, 0 from R on, which keeps the singularity:
   * (1 − χ) ψ has r^{5/2}.
   */
  struct SingularFunction
  {
    /** Values of ψ and ∂ψ/∂x, in the coordinates of the mesh.
     * @param cell_center Centre of the cell of the point. */
    dealii::Tensor<1, 2>
    value(const dealii::Point<2> &point,
          const dealii::Point<2> &cell_center) const;
    dealii::Tensor<2, 2>
    gradient(const dealii::Point<2> &point,
             const dealii::Point<2> &cell_center) const;

    /** Whether ψ opens a crack that may close at the tip, so that its
     * coefficient must not be negative. */
    bool
    opens() const
    {
      return mode == CrackMode::opening && stress_intensity > 0. &&
             !tip.is_open;
    }

    CrackTip   tip;
    CrackMode  mode;
    PolarField field;
    double     radius; ///< R; infinite: χ = 1

    /** K of a unit coefficient of w₁ (stress √length / length); 0 for D, w₃. */
    double stress_intensity;
  };

  /** Singular functions of all tips; empty: none are used. */
  using SingularFunctions = std::vector<SingularFunction>;

  /** First n functions of mode I, and of mode II at a tip with two lips.
   *
   * @param n Number from 1 to 3.
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
   * nodal interpolation I_h. They vanish at the nodes (except hanging ones),
   * where displacements, constraints and the bounds of the lip keep their
   * meaning, and are small away from the tip without a cut-off. On a supported
   * boundary, φ between the nodes is of the order of the interpolation error.
   *
   * ∂φ/∂x is corrected by a constant in each cell, so that its integral by the
   * rule of the cell is ∮ φ ⊗ n. No rule for cells is exact at the tip, least
   * in elongated cells; with this, loads of a uniform stress balance it to
   * rounding, as without singular functions (Chen, Hillman, Rüter, Int. J.
   * Numer. Methods Eng. 95, 2013: variational consistency).
   */
  class SingularShapes
  {
  public:
    /** @param face_rule Rule of faces that do not end at a tip. */
    SingularShapes(const SingularFunctions     &functions,
                   const dealii::Mapping<2>    &mapping,
                   const dealii::DoFHandler<2> &dof_handler,
                   const dealii::Quadrature<1> &face_rule);

    const SingularFunctions functions;

    unsigned int
    size() const
    {
      return functions.size();
    }

    /** Values φ_k of all functions at the points of a cell or face.
     * @param values Shape function values and quadrature points. */
    void
    values(const dealii::FEValuesBase<2>                  &values,
           std::vector<std::vector<dealii::Tensor<1, 2>>> &result) const;

    /** Gradients ∂φ_k/∂x of all functions in a cell of this rank.
     * @param values Gradients, weights and quadrature points of the cell's
     * rule, none of which is the tip. */
    void
    gradients(const dealii::FEValues<2>                      &values,
              std::vector<std::vector<dealii::Tensor<2, 2>>> &result) const;

    /** Rule for a face that ends at a tip, exact for polynomials of √r; none
     * for other faces. */
    std::optional<dealii::Quadrature<1>>
    rule_from_tip(const dealii::Triangulation<2>::face_iterator &face) const;

  private:
    void
    find_fluxes(const dealii::Mapping<2>    &mapping,
                const dealii::DoFHandler<2> &dof_handler,
                const dealii::Quadrature<1> &face_rule);

    std::vector<Vector> interpolated; ///< I_h ψ with ghost values
    /** ∮ φ ⊗ n of each function and active cell of this rank. */
    std::vector<std::vector<dealii::Tensor<2, 2>>> fluxes;
  };
} // namespace Crevasse

#endif
