// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_crack_tip_tip_region_h
#define crevasse_crack_tip_tip_region_h

#include <crevasse/base/summary.h>
#include <crevasse/crack_tip/auxiliary_field.h>
#include <crevasse/discretisation/point_values.h>
#include <crevasse/discretisation/quadrature_field.h>

namespace Crevasse
{
  /** Where the quadrature points of this rank are, in the order of a
   * QuadratureField. The one place around the crack tip that knows by which
   * rule the fields live at points. */
  struct PointGeometry
  {
    PointGeometry(const Space<2> &space, const QuadratureField<2> &points);

    std::vector<dealii::Point<2>> location;
    std::vector<double>           weight; ///< JxW
    std::vector<unsigned int>     cell;   ///< active cell index
  };



  /** For the summary. */
  inline Summary
  place_of(const CrackTip &tip)
  {
    return {{"position", {tip.position[0], tip.position[1]}},
            {"direction", {tip.ahead[0], tip.ahead[1]}}};
  }



  /**
   * The surroundings of a crack tip, in which the body ends nowhere but at its
   * lips and the plane of symmetry, and no other tip is. Distances are
   * max(|X|, |Y|): they belong to squares |X| ≤ R, 0 ≤ Y ≤ R, or |Y| ≤ R where
   * the tip has two lips.
   */
  class TipRegion
  {
  public:
    /** Collective.
     * @throw SceneError if another boundary begins within the cells at the tip.
     */
    TipRegion(const Space<2> &space, const CrackTip &tip);

    const CrackTip tip;

    /** Where another boundary begins, or another tip is. */
    double
    largest_radius() const
    {
      return end;
    }

    /** What a stiffness or viscosity is in the cells at the tip, and where it
     * is no more that, at most largest_radius(); 0 if it differs within these
     * cells or is not isotropic in the plane there. */
    struct Uniform
    {
      VoigtMatrix<2> matrix;
      double         radius;
    };

    /** Collective. */
    Uniform
    uniform(const PointGeometry               &points,
            const PointValues<VoigtMatrix<2>> &matrices) const;

    /** The aligned_radius() of what the scene wants for squares.
     * @param wish its [Crack tip] Radius.
     * @param most where something ends.
     * @throw SceneError if the wish is more, or within the cells at the tip. */
    double
    square(const double wish, const double most) const;

    /** Of the cells that have the tip as a vertex. */
    double cell_radius = 0.;

    /** The largest square that cuts no cell, half to once this size; this
     * size if each of those cuts one. */
    double
    aligned_radius(const double at_most) const;

    /** From where to where a cell reaches. */
    using Interval = std::pair<double, double>;

    /** That of a cell of this rank, by its active cell index; from 0 on at the
     * tip. */
    const Interval &
    reach(const unsigned int cell) const
    {
      return cells[cell];
    }

    /** Of a square that cuts cells, or does not but for rounding. Collective.
     */
    SquareWeight
    weight(const double size) const;

  private:
    void
    measure_cells(const Space<2> &space);
    void
    find_boundaries(const Space<2> &space);

    const MPI_Comm        communicator;
    std::vector<Interval> cells; ///< by active cell index
    double                end = 0.;
  };
} // namespace Crevasse

#endif
