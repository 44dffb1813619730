// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/collectively.h>
#include <crevasse/crack_tip/square_region.h>

#include <algorithm>
#include <limits>

namespace Crevasse
{
  using namespace dealii;

  SquareRegion::SquareRegion(const MPI_Comm     communicator,
                             const unsigned int n_cells)
    : communicator(communicator)
    , cells(n_cells, {std::numeric_limits<double>::max(), 0.})
  {
  }



  SquareWeight
  SquareRegion::weight(const double size) const
  {
    const bool on_rank =
      std::any_of(cells.begin(), cells.end(), [size](const Interval &cell) {
        return cell.first < size * (1. - rounding) &&
               size * (1. + rounding) < cell.second;
      });
    return {size, Utilities::MPI::max(on_rank ? 3 : 2, communicator)};
  }



  double
  SquareRegion::aligned_radius(const double at_most) const
  {
    std::vector<Interval> near;
    for (const Interval &cell : cells)
      if (cell.first < at_most && cell.second > 0.5 * at_most)
        near.push_back(cell);
    std::vector<Interval> all = of_all_ranks(communicator, near);
    std::sort(all.begin(), all.end(), [](const Interval &a, const Interval &b) {
      return a.second > b.second;
    });

    // A square cuts a cell with points inside and outside. The remaining radius
    // cuts none of the cells before, which are larger.
    double radius = at_most;
    for (const Interval &cell : all)
      {
        if (cell.second <= radius * (1. + rounding))
          break;
        radius = std::min(radius, cell.first);
      }
    return radius >= std::max(0.5 * at_most * (1. - rounding),
                              cell_radius * (1. - rounding))
             ? radius
             : at_most;
  }
} // namespace Crevasse
