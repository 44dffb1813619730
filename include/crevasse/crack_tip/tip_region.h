// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_crack_tip_tip_region_h
#define crevasse_crack_tip_tip_region_h

#include <crevasse/discretisation/crack_tip.h>
#include <crevasse/discretisation/point_values.h>
#include <crevasse/discretisation/quadrature_field.h>
#include <crevasse/discretisation/space.h>
#include <crevasse/material/plane_elasticity.h>

#include <optional>
#include <utility>
#include <vector>

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



  /**
   * The surroundings of a crack tip in which the body is the same everywhere
   * and ends nowhere but at the lip and the plane of symmetry. Distances are
   * max(|X|, |Y|): they belong to squares |X| ≤ R, 0 ≤ Y ≤ R.
   */
  class TipRegion
  {
  public:
    /**
     * Collective.
     *
     * @param stiffness at the quadrature points, or the viscosity.
     * @param name of it, for messages.
     * @throw SceneError if it is not isotropic at the tip, or not the same in
     * all cells at the tip.
     */
    TipRegion(const Space<2>                    &space,
              const PointGeometry               &points,
              const PointValues<VoigtMatrix<2>> &stiffness,
              const char                        *name);

    const CrackTip &
    tip() const
    {
      return crack_tip;
    }

    /** Of the stiffness at the tip. */
    const PlaneElasticity &
    elasticity() const
    {
      return *plane_elasticity;
    }

    /** Where another boundary or another stiffness begins. */
    double
    largest_radius() const
    {
      return end;
    }

    /** Of the cells that have the tip as a vertex. */
    double
    cell_radius() const
    {
      return end_of_tip_cells;
    }

    /** The largest square that cuts no cell, half to once this size; this
     * size if each of those cuts one. */
    double
    aligned_radius(const double at_most) const;

    /** Whether a cell of this rank is of the body around the tip: any is,
     * unless another stiffness begins; then those that do not touch it. */
    bool
    is_of_tip(const unsigned int cell) const;

    /** From where on a cell of this rank reaches outwards, by its active cell
     * index; 0 at the tip. */
    double
    distance(const unsigned int cell) const
    {
      return cells[cell].first;
    }

  private:
    /** From where to where a cell reaches. */
    using Interval = std::pair<double, double>;

    void
    measure_cells(const Space<2> &space);
    void
    find_boundaries(const Space<2> &space);

    const MPI_Comm                 communicator;
    const CrackTip                 crack_tip;
    std::vector<Interval>          cells; ///< by active cell index
    std::optional<PlaneElasticity> plane_elasticity;
    double                         end = 0., end_of_tip_cells = 0.;
    bool                           ends_at_other_stiffness = false;
  };
} // namespace Crevasse

#endif
