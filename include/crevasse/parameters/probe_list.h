// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_parameters_probe_list_h
#define crevasse_parameters_probe_list_h

#include <deal.II/base/point.h>

#include <string>
#include <vector>

namespace Crevasse
{
  /** A point where quantities are recorded over time, before the dimension is
   * known; the name becomes part of a file name. */
  struct NamedPoint
  {
    std::string         name;
    std::vector<double> coordinates;
  };

  /** Parses probes "name: x, y; name: x, y"; an empty text and "automatic" give
   * none.
   *
   * @throw SceneError that says what is expected. */
  std::vector<NamedPoint>
  parse_probes(const std::string &text);

  /** Coordinates. @throw SceneError unless numbers separated by commas. */
  std::vector<double>
  parse_coordinates(const std::string &text);

  /** Converts coordinates to a point. @throw SceneError if not dim. */
  template <int dim>
  dealii::Point<dim>
  to_point(const std::vector<double> &coordinates);
} // namespace Crevasse

#endif
