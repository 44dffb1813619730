// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_grid_cell_quality_h
#define crevasse_grid_cell_quality_h

#include <deal.II/grid/tria.h>

#include <vector>

namespace Crevasse
{
  /** Smallest scaled Jacobian of each active cell: the Jacobian determinant
   * over the product of the lengths of its columns, which is 1 for right
   * angles, and not above 0 where the cell folds over. It is taken at corners;
   * in a mesh with curved edges, also at middles of edges and in the interior.
   * Needs all cells of the mesh on this rank. */
  template <int dim>
  std::vector<double>
  scaled_jacobians(const dealii::Triangulation<dim> &mesh);
} // namespace Crevasse

#endif
