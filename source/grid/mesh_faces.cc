// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/problems.h>
#include <crevasse/base/text.h>
#include <crevasse/grid/mesh_faces.h>

#include <algorithm>
#include <array>
#include <tuple>

namespace Crevasse
{
  namespace
  {
    struct Face
    {
      std::array<std::size_t, 4> nodes;    ///< sorted; a line uses the last two
      std::size_t                opposite; ///< node opposite to the smallest
      std::size_t                element;
      unsigned int               group;
    };

    Face
    make_face(const std::vector<std::size_t> &nodes, const MeshElement &element)
    {
      // Gmsh numbers nodes from 1: 0 means no node.
      Face face{{{0, 0, 0, 0}}, 0, element.number, element.group};
      std::copy(nodes.rbegin(), nodes.rend(), face.nodes.rbegin());
      if (nodes.size() == 4)
        {
          const auto smallest = std::min_element(nodes.begin(), nodes.end());
          face.opposite       = nodes[(smallest - nodes.begin() + 2) % 4];
        }
      std::sort(face.nodes.begin(), face.nodes.end());
      return face;
    }



    bool
    is_before(const Face &a, const Face &b)
    {
      return std::tie(a.nodes, a.element) < std::tie(b.nodes, b.element);
    }



    [[noreturn]] void
    throw_error(const Face &face, const std::string &reason)
    {
      std::vector<std::string> nodes;
      for (const std::size_t node : face.nodes)
        if (node > 0)
          nodes.push_back(std::to_string(node));
      throw SceneError("element " + std::to_string(face.element) +
                       ": the nodes " + Text::join(nodes, ", ") + ' ' + reason);
    }



    void
    check_cells(const std::vector<Face> &faces)
    {
      for (std::size_t i = 1; i < faces.size(); ++i)
        {
          const Face &before = faces[i - 1], &face = faces[i];
          if (face.nodes != before.nodes)
            continue;
          const std::string other = std::to_string(before.element);
          if (face.opposite != before.opposite)
            throw_error(face,
                        "of a face are in another order in the element " +
                          other);
          if (i > 1 && faces[i - 2].nodes == face.nodes)
            throw_error(
              face,
              "are a face of this cell and of two others, the elements " +
                std::to_string(faces[i - 2].element) + " and " + other);
        }
    }



    /** Whether a boundary element is on the surface of the body.
     * @param must_be Whether its group has a role, so that it must be.
     * @throw SceneError if it is not, but must be. */
    bool
    is_on_surface(const Face              &face,
                  const std::vector<Face> &of_cells,
                  const bool               must_be)
    {
      const auto [begin, end] =
        std::equal_range(of_cells.begin(),
                         of_cells.end(),
                         face,
                         [](const Face &a, const Face &b) {
                           return a.nodes < b.nodes;
                         });
      const bool is_face = begin != end && begin->opposite == face.opposite;
      if (must_be && !is_face)
        throw_error(
          face, "are no face of a cell; only faces of cells can be boundary");
      if (must_be && end - begin > 1)
        throw_error(face,
                    "are a face within the body, between the elements " +
                      std::to_string(begin->element) + " and " +
                      std::to_string((begin + 1)->element) +
                      ", and its group " + std::to_string(face.group) +
                      " has a role; only the surface of the body can have one, "
                      "and a crack that [Boundary] Crack names");
      return is_face && end - begin == 1;
    }
  } // namespace



  std::vector<std::vector<std::size_t>>
  nodes_of_faces(const MeshElement &cell)
  {
    using Faces = std::vector<std::vector<std::size_t>>;
    // Nodes of each face, in Gmsh's order of the nodes of a cell.
    static const Faces of_quadrilateral = {{0, 1}, {1, 2}, {2, 3}, {3, 0}};
    static const Faces of_hexahedron    = {{0, 1, 2, 3},
                                           {4, 5, 6, 7},
                                           {0, 1, 5, 4},
                                           {1, 2, 6, 5},
                                           {2, 3, 7, 6},
                                           {3, 0, 4, 7}};

    Faces faces = cell.nodes.size() == 4 ? of_quadrilateral : of_hexahedron;
    for (auto &face : faces)
      for (std::size_t &node : face)
        node = cell.nodes[node];
    return faces;
  }



  std::vector<std::size_t>
  sorted_nodes(std::vector<std::size_t> nodes)
  {
    std::sort(nodes.begin(), nodes.end());
    return nodes;
  }



  void
  check_faces(const std::vector<MeshElement> &cells,
              const std::set<unsigned int>   &groups,
              std::vector<MeshElement>       &boundary)
  {
    std::vector<Face> of_cells;
    for (const MeshElement &cell : cells)
      for (const auto &nodes : nodes_of_faces(cell))
        of_cells.push_back(make_face(nodes, cell));
    std::sort(of_cells.begin(), of_cells.end(), is_before);
    check_cells(of_cells);

    const auto is_inner = [&](const MeshElement &element) {
      return !is_on_surface(make_face(element.nodes, element),
                            of_cells,
                            groups.count(element.group) > 0);
    };
    boundary.erase(std::remove_if(boundary.begin(), boundary.end(), is_inner),
                   boundary.end());
  }
} // namespace Crevasse
