// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/text.h>
#include <crevasse/grid/corner_angles.h>
#include <crevasse/grid/crack_tip.h>
#include <crevasse/grid/singular_place.h>

#include <algorithm>

namespace Crevasse
{
  using namespace dealii;

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
        const auto       corners    = corner_angles(mesh);
        const auto       sharpest =
          std::max_element(corners.begin(),
                           corners.end(),
                           [](const auto &a, const auto &b) {
                             return a.second < b.second;
                           });
        if (sharpest != corners.end() && sharpest->second > re_entrant)
          return describe("re-entrant corner " +
                            Text::from_point(
                              mesh.get_vertices()[sharpest->first]),
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
