// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_crack_tip_square_region_h
#define crevasse_crack_tip_square_region_h

#include <crevasse/crack_tip/auxiliary_field.h>

#include <utility>
#include <vector>

namespace Crevasse
{
  /** Cells around a crack tip or front by their distances max(|X|, |Y|) from
   * it, and squares across it that suit them. */
  class SquareRegion
  {
  public:
    /** Size of the cells that have the tip as a vertex, or one on the front. */
    double cell_radius = 0.;

    /** Distance of the tip or front to another boundary or another tip; along a
     * front at most half its radius of curvature. */
    double
    largest_radius() const
    {
      return end;
    }

    /** Least and largest distance of a cell from the tip or front. */
    using Interval = std::pair<double, double>;

    /** Interval of a cell of this rank, by its active cell index; it begins
     * with 0 at the tip. */
    const Interval &
    reach(const unsigned int cell) const
    {
      return cells[cell];
    }

    /** Whether a cell of this rank overlaps a square by more than rounding. */
    bool
    overlaps(const unsigned int cell, const double size) const
    {
      return reach(cell).first < size * (1. - rounding);
    }

    /** Size of the largest square that cuts no cell, from half of @p at_most
     * on; @p at_most if all these squares cut cells. Collective. */
    double
    aligned_radius(const double at_most) const;

    /** Weight of a square; its exponent depends on whether it cuts cells.
     * Collective. */
    SquareWeight
    weight(const double size) const;

  protected:
    /** @param n_cells number of active cells that the rank knows. */
    SquareRegion(const MPI_Comm communicator, const unsigned int n_cells);

    static constexpr double rounding = 1e-10;

    const MPI_Comm        communicator;
    double                end = 0.; ///< largest_radius()
    std::vector<Interval> cells;    ///< by active cell index; at first far away
  };
} // namespace Crevasse

#endif
