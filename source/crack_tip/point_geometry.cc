// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/crack_tip/point_geometry.h>
#include <crevasse/discretisation/cell_values.h>

namespace Crevasse
{
  using namespace dealii;

  PointGeometry::PointGeometry(const Space<2>           &space,
                               const QuadratureField<2> &points)
    : location(points.n_local_points())
    , weight(points.n_local_points())
    , cell(points.n_local_points())
  {
    CellValues<2> cell_values(space,
                              update_quadrature_points | update_JxW_values);
    for (const auto &active : space.dof_handler().active_cell_iterators())
      if (active->is_locally_owned())
        {
          const FEValues<2> &values = cell_values.reinit(active);
          const std::size_t  first =
            points.offset(active) / QuadratureField<2>::n_components;
          for (const unsigned int q : values.quadrature_point_indices())
            {
              location[first + q] = values.quadrature_point(q);
              weight[first + q]   = values.JxW(q);
              cell[first + q]     = active->active_cell_index();
            }
        }
  }
} // namespace Crevasse
