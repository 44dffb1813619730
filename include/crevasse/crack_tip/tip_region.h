// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_crack_tip_tip_region_h
#define crevasse_crack_tip_tip_region_h

#include <crevasse/base/summary.h>
#include <crevasse/crack_tip/lip_path.h>
#include <crevasse/crack_tip/square_region.h>
#include <crevasse/discretisation/point_values.h>
#include <crevasse/discretisation/quadrature_field.h>
#include <crevasse/grid/front_curve.h>

namespace Crevasse
{
  /** Positions, weights and cells of this rank's quadrature points, in the
   * order of a QuadratureField. Only this class, among those at the crack tip,
   * knows the quadrature rule of fields at points. */
  struct PointGeometry
  {
    PointGeometry(const Space<2> &space, const QuadratureField<2> &points);

    std::vector<dealii::Point<2>> location;
    std::vector<double>           weight; ///< weight JxW
    std::vector<unsigned int>     cell;   ///< active cell index
  };



  /** Position and direction of a tip, for the summary. */
  inline Summary
  place_of(const CrackTip &tip)
  {
    return {{"position", {tip.position[0], tip.position[1]}},
            {"direction", {tip.ahead[0], tip.ahead[1]}}};
  }



  /**
   * The surroundings of a crack tip, in which the body has no boundary but its
   * lips and the plane of symmetry, and no other tip. Distances are max(|X|,
   * |Y|): they belong to squares |X| ≤ R, 0 ≤ Y ≤ R, or |Y| ≤ R where the tip
   * has two lips.
   */
  class TipRegion : public SquareRegion
  {
  public:
    /** Collective.
     * @param bends whether curved lips belong to the region, too.
     * @throw SceneError if another boundary begins in the cells at the tip. */
    TipRegion(const Space<2> &space,
              const CrackTip &tip,
              const bool      bends = false);

    const CrackTip tip;
    const LipPath  path;

    /** Frame at (X, Y) of a front across the plane: a line, or a circle about
     * the axis of a body of revolution. */
    FrontFrame
    frame(const dealii::Point<2> &local) const;

    /** Whether lips in the region bend. */
    bool
    has_bends() const
    {
      return bends && path.is_curved();
    }

    /** LipPath::sign_of_root() of fields in the region. */
    double
    sign_of_root(const dealii::Point<2> &center,
                 const dealii::Point<2> &local) const
    {
      return has_bends() ? path.sign_of_root(center, local) : 1.;
    }

    /** Whether a face of a lip, with these ends, is one of the tip's. */
    bool
    is_of_tip(const dealii::Point<2> &a, const dealii::Point<2> &b) const
    {
      return has_bends() ? path.has_node(a) && path.has_node(b)
                         : tip.is_on_line(a) && tip.is_on_line(b);
    }

    /** A stiffness or viscosity in the cells at the tip, and the size of the
     * square in which it is uniform, at most largest_radius(); 0 if it varies
     * in these cells. Between two materials it is uniform on either side. */
    struct Uniform
    {
      VoigtMatrix<2> matrix; ///< above, or on both sides
      double         radius;
      VoigtMatrix<2> below;
    };

    /** Finds where given matrices are uniform, or are on either side.
     * Collective.
     */
    Uniform
    uniform(const PointGeometry               &points,
            const PointValues<VoigtMatrix<2>> &matrices,
            const bool                         by_side = false) const;

    /** The aligned_radius() of the size that the scene asks for.
     * @param wish [Crack tip] Radius of the scene.
     * @param most largest size allowed.
     * @throw SceneError if the wish is larger or in the cells at the tip. */
    double
    square(const double wish, const double most) const;

  private:
    void
    measure_cells(const Space<2> &space);
    void
    find_boundaries(const Space<2> &space);

    const bool bends;
    const bool has_axis;
  };
} // namespace Crevasse

#endif
