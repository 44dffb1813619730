// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/file_words.h>
#include <crevasse/base/text.h>
#include <crevasse/grid/mesh_faces.h>

#include <algorithm>
#include <tuple>

namespace Crevasse
{
  namespace
  {
    using LocalFaces = std::vector<std::vector<unsigned int>>;

    /** The nodes of each face, in Gmsh's order of the nodes of a cell. */
    const LocalFaces &
    local_faces(const std::size_t n_nodes)
    {
      static const LocalFaces of_quadrilateral = {{0, 1},
                                                  {1, 2},
                                                  {2, 3},
                                                  {3, 0}};
      static const LocalFaces of_hexahedron    = {{0, 1, 2, 3},
                                                  {4, 5, 6, 7},
                                                  {0, 1, 5, 4},
                                                  {1, 2, 6, 5},
                                                  {2, 3, 7, 6},
                                                  {3, 0, 4, 7}};
      return n_nodes == 4 ? of_quadrilateral : of_hexahedron;
    }



    std::string
    list_nodes(const std::array<int, 4> &nodes)
    {
      std::vector<std::string> numbers;
      for (const int node : nodes)
        if (node >= 0)
          numbers.push_back(std::to_string(node));
      return "the nodes " + Text::join(numbers, ", ");
    }
  } // namespace



  MeshFaces::Face
  MeshFaces::make_face(const std::vector<int> &nodes,
                       const int               boundary_id,
                       const unsigned int      line)
  {
    Face face{{{-1, -1, -1, -1}}, -1, boundary_id, line};
    std::copy(nodes.rbegin(), nodes.rend(), face.nodes.rbegin());
    if (nodes.size() == 4)
      {
        const auto smallest = std::min_element(nodes.begin(), nodes.end());
        face.opposite       = nodes[(smallest - nodes.begin() + 2) % 4];
      }
    std::sort(face.nodes.begin(), face.nodes.end());
    return face;
  }



  void
  MeshFaces::add_cell(const std::vector<int> &nodes, const unsigned int line)
  {
    for (const auto &local_face : local_faces(nodes.size()))
      {
        std::vector<int> face;
        for (const unsigned int i : local_face)
          face.push_back(nodes[i]);
        of_cells.push_back(make_face(face, 0, line));
      }
  }



  void
  MeshFaces::add_boundary(const std::vector<int> &nodes,
                          const int               id,
                          const unsigned int      line)
  {
    of_boundary.push_back(make_face(nodes, id, line));
  }



  bool
  MeshFaces::has_cells() const
  {
    return !of_cells.empty();
  }



  void
  MeshFaces::sort(std::vector<Face> &faces)
  {
    std::sort(faces.begin(), faces.end(), [](const Face &a, const Face &b) {
      return std::tie(a.nodes, a.line) < std::tie(b.nodes, b.line);
    });
  }



  void
  MeshFaces::check()
  {
    sort(of_cells);
    check_cells();
    for (const Face &boundary : of_boundary)
      check_boundary(boundary);
    sort(of_boundary);
    check_boundary_ids();
  }



  void
  MeshFaces::check_cells() const
  {
    for (std::size_t i = 1; i < of_cells.size(); ++i)
      {
        const Face &before = of_cells[i - 1], &face = of_cells[i];
        if (face.nodes != before.nodes)
          continue;
        if (face.opposite != before.opposite)
          FileWords::refuse(face.line,
                            "this cell and that on line " +
                              std::to_string(before.line) + " have " +
                              list_nodes(face.nodes) +
                              " of a face in different orders");
        if (i > 1 && of_cells[i - 2].nodes == face.nodes)
          FileWords::refuse(face.line,
                            list_nodes(face.nodes) +
                              " are a face of this cell and of two others, on "
                              "the lines " +
                              std::to_string(of_cells[i - 2].line) + " and " +
                              std::to_string(before.line));
      }
  }



  void
  MeshFaces::check_boundary(const Face &boundary) const
  {
    const auto [begin, end] =
      std::equal_range(of_cells.begin(),
                       of_cells.end(),
                       boundary,
                       [](const Face &a, const Face &b) {
                         return a.nodes < b.nodes;
                       });
    if (begin == end || begin->opposite != boundary.opposite)
      FileWords::refuse(boundary.line,
                        list_nodes(boundary.nodes) +
                          " are no face of a cell; only faces of cells can be "
                          "boundary");
    if (end - begin > 1)
      FileWords::refuse(boundary.line,
                        list_nodes(boundary.nodes) +
                          " are a face within the body, between the cells on "
                          "the lines " +
                          std::to_string(begin->line) + " and " +
                          std::to_string((begin + 1)->line) +
                          "; only its surface can be boundary (Gmsh: physical "
                          "groups of the surface alone, Mesh.SaveAll = 0)");
  }



  void
  MeshFaces::check_boundary_ids() const
  {
    for (std::size_t i = 1; i < of_boundary.size(); ++i)
      {
        const Face &before = of_boundary[i - 1], &face = of_boundary[i];
        if (face.nodes == before.nodes &&
            face.boundary_id != before.boundary_id)
          FileWords::refuse(face.line,
                            list_nodes(face.nodes) + " have the boundary id " +
                              std::to_string(face.boundary_id) +
                              ", but on line " + std::to_string(before.line) +
                              " " + std::to_string(before.boundary_id) +
                              "; each belongs to one physical group at most");
      }
  }
} // namespace Crevasse
