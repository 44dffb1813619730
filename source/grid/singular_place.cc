// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/text.h>
#include <crevasse/grid/crack_tip.h>
#include <crevasse/grid/singular_place.h>

#include <deal.II/grid/tria_accessor.h>

#include <map>
#include <set>

namespace Crevasse
{
  using namespace dealii;

  namespace
  {
    /** The vertex with the largest angle within the body between straight
     * sides, and this angle. */
    std::pair<Point<2>, double>
    sharpest_corner(const Triangulation<2> &mesh)
    {
      std::map<unsigned int, double> angles;
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
      std::pair<Point<2>, double> sharpest = {};
      for (const unsigned int v : sides)
        if (curved.count(v) == 0 && angles[v] > sharpest.second)
          sharpest = {mesh.get_vertices()[v], angles[v]};
      return sharpest;
    }
  } // namespace



  template <int dim>
  std::string
  why_stress_is_unbounded(const Triangulation<dim> &mesh,
                          const BoundaryRoles      &roles)
  {
    const auto describe = [](const std::string &place,
                             const std::string &instead) {
      return "the stress is singular at the " + place +
             ": its largest value grows as cells shrink there, and no mesh "
             "bounds it. " +
             instead;
    };
    if (const auto front = crack_front(mesh, roles); !front.empty())
      return describe(dim == 2 ? "crack tip " + Text::from_point(front[0].first)
                               : "crack front",
                      "Judge the crack by K");
    if constexpr (dim == 2)
      {
        constexpr double re_entrant = 1.25 * numbers::PI;
        if (const auto [point, angle] = sharpest_corner(mesh);
            angle > re_entrant)
          return describe("re-entrant corner " + Text::from_point(point),
                          "Round the corner, or judge the stress at a distance "
                          "from it");
      }
    return "";
  }



  template std::string
  why_stress_is_unbounded(const Triangulation<2> &, const BoundaryRoles &);
  template std::string
  why_stress_is_unbounded(const Triangulation<3> &, const BoundaryRoles &);
} // namespace Crevasse
