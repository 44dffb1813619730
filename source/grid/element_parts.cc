// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/grid/element_parts.h>

#include <utility>

namespace Crevasse
{
  namespace
  {
    using Parts = std::vector<ElementPart>;



    Parts
    parts_of_line(const bool is_split)
    {
      if (is_split)
        return {{{0}, {0, 1}}, {{0, 1}, {1}}};
      return {{{0}, {1}}};
    }



    Parts
    parts_of_triangle()
    {
      Parts parts;
      for (unsigned int i = 0; i < 3; ++i)
        parts.push_back({{i}, {i, (i + 1) % 3}, {0, 1, 2}, {(i + 2) % 3, i}});
      return parts;
    }



    Parts
    parts_of_tetrahedron()
    {
      Parts parts;
      for (unsigned int i = 0; i < 4; ++i)
        {
          const unsigned int j = (i + 1) % 4, k = (i + 2) % 4, l = (i + 3) % 4;
          parts.push_back({{i},
                           {i, j},
                           {i, j, k},
                           {i, k},
                           {i, l},
                           {i, j, l},
                           {0, 1, 2, 3},
                           {i, k, l}});
        }
      return parts;
    }



    /** Parts of the product of an element of @p n vertices and a line. */
    Parts
    product(const Parts &base, const unsigned int n, const Parts &line)
    {
      Parts parts;
      for (const ElementPart &of_base : base)
        for (const ElementPart &of_line : line)
          {
            parts.emplace_back();
            for (const Corners &layers : of_line)
              for (const Corners &corners : of_base)
                {
                  parts.back().emplace_back();
                  for (const unsigned int layer : layers)
                    for (const unsigned int corner : corners)
                      parts.back().back().push_back(corner + n * layer);
                }
          }
      return parts;
    }



    Parts
    parts_of_quadrilateral(const bool along_first, const bool along_second)
    {
      auto parts =
        product(parts_of_line(along_first), 2, parts_of_line(along_second));
      // From the order of a product to Gmsh's cyclic order.
      for (ElementPart &part : parts)
        {
          std::swap(part[2], part[3]);
          for (Corners &corners : part)
            for (unsigned int &corner : corners)
              corner = corner > 1 ? 5 - corner : corner;
        }
      return parts;
    }
  } // namespace



  std::vector<ElementPart>
  parts_of_element(
    const unsigned int                                     element_dim,
    const unsigned int                                     n_vertices,
    const std::function<bool(unsigned int, unsigned int)> &is_divided)
  {
    if (element_dim == 1)
      return parts_of_line(is_divided(0, 1));
    if (n_vertices == 3)
      return parts_of_triangle();
    if (n_vertices == 6)
      return product(parts_of_triangle(), 3, parts_of_line(is_divided(0, 3)));
    if (element_dim == 3 && n_vertices == 4)
      return parts_of_tetrahedron();
    const auto parts =
      parts_of_quadrilateral(is_divided(0, 1), is_divided(1, 2));
    return element_dim == 2
             ? parts
             : product(parts, 4, parts_of_line(is_divided(0, 4)));
  }
} // namespace Crevasse
