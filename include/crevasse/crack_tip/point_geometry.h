// ---------------------------------------------------------------------
//
// Copyright (C) 2026 by the Crevasse authors
//
// This file is part of Crevasse. It is free software; you can use it,
// redistribute it and/or modify it under the terms of the GNU Lesser
// General Public License as published by the Free Software Foundation;
// either version 2.1 of the License, or (at your option) any later version.
//
// ---------------------------------------------------------------------

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
