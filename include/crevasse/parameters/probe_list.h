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

  /** "name: x, y; name: x, y" as probes; nothing gives none.
   *
   * @throw SceneError that tells what is expected. */
  template <int dim>
  std::vector<Probe<dim>>
  parse_probes(const std::string &text);
} // namespace Crevasse

#endif
