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
