// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_crack_tip_point_geometry_h
#define crevasse_crack_tip_point_geometry_h

#include <crevasse/discretisation/quadrature_field.h>
#include <crevasse/discretisation/space.h>

#include <deal.II/base/point.h>

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
} // namespace Crevasse

#endif
