// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_temperature_vtu_reader_h
#define crevasse_temperature_vtu_reader_h

#include <crevasse/temperature/cell_locator.h>

#include <string>
#include <vector>

namespace Crevasse
{
  /** A temperature at the vertices of a mesh. */
  template <int dim>
  struct VertexField
  {
    CellMesh<dim>       mesh;
    std::vector<double> values;
  };

  /**
   * Adds what a .vtu file has, or the files that a .pvtu names. Its scalar at
   * points named theta, temperature or T is taken, or else its only one. Of
   * quadratic cells the corners are taken. Cells of less dimensions, such as
   * those of boundaries, are left out.
   *
   * Vertices that several cells or files have in common are not merged, so that
   * a temperature may jump across a crack.
   *
   * @throw SceneError that begins with the name of the file.
   */
  template <int dim>
  void
  read_vtu(const std::string &file_name, VertexField<dim> &field);
} // namespace Crevasse

#endif
