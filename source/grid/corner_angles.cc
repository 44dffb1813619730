// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/grid/corner_angles.h>

#include <deal.II/grid/tria_accessor.h>

#include <set>

namespace Crevasse
{
  using namespace dealii;

  std::map<unsigned int, double>
  corner_angles(const Triangulation<2> &mesh)
  {
    std::map<unsigned int, double> angles, corners;
    std::set<unsigned int>         sides, curved;
    for (const auto &cell : mesh.cell_iterators_on_level(0))
      {
        for (const unsigned int v : cell->vertex_indices())
          {
            // Neighbours of a vertex differ in one bit of its number.
            const Tensor<1, 2> a = cell->vertex(v ^ 1u) - cell->vertex(v),
                               b = cell->vertex(v ^ 2u) - cell->vertex(v);
            angles[cell->vertex_index(v)] +=
              std::acos(std::clamp(a * b / (a.norm() * b.norm()), -1., 1.));
          }
        for (const auto &face : cell->face_iterators())
          if (face->at_boundary())
            for (const unsigned int v : {0, 1})
              {
                sides.insert(face->vertex_index(v));
                if (face->manifold_id() != numbers::flat_manifold_id)
                  curved.insert(face->vertex_index(v));
              }
      }
    for (const unsigned int v : sides)
      if (curved.count(v) == 0)
        corners[v] = angles[v];
    return corners;
  }
} // namespace Crevasse
