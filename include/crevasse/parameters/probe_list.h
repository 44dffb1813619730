// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_parameters_probe_list_h
#define crevasse_parameters_probe_list_h

#include <deal.II/base/point.h>

#include <string>
#include <vector>

namespace Crevasse
{
  /** A point where quantities are recorded over time; the name becomes part of
   * a file name. */
  template <int dim>
  struct Probe
  {
    std::string        name;
    dealii::Point<dim> point;
  };

  /** As in a scene, whose dimension is another parameter. */
  struct NamedPoint
  {
    std::string         name;
    std::vector<double> coordinates;
  };

  /** Reads "name: x, y; name: x, y"; nothing gives none, and so does
   * "automatic".
   *
   * @throw SceneError that says what is expected. */
  std::vector<NamedPoint>
  parse_probes(const std::string &text);

  /** @throw SceneError unless the text is numbers separated by commas. */
  std::vector<double>
  parse_coordinates(const std::string &text);

  /** @throw SceneError unless there are as many coordinates. */
  template <int dim>
  dealii::Point<dim>
  to_point(const std::vector<double> &coordinates);
} // namespace Crevasse

#endif
