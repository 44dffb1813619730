// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/problems.h>
#include <crevasse/grid/cut_cracks.h>

#include <algorithm>

namespace Crevasse
{
  namespace
  {
    using Nodes = std::vector<std::size_t>;
    /** Cell of a face, and the number of the face in the cell. */
    using CellFace = std::pair<std::size_t, std::size_t>;
    /** Cells and numbers of faces, by the sorted nodes of the faces. */
    using Faces = std::map<Nodes, std::vector<CellFace>>;



    Faces
    faces_of(const std::vector<MeshElement> &cells)
    {
      Faces faces;
      for (std::size_t c = 0; c < cells.size(); ++c)
        {
          const std::vector<Nodes> of_cell = nodes_of_faces(cells[c]);
          for (std::size_t f = 0; f < of_cell.size(); ++f)
            faces[sorted_nodes(of_cell[f])].emplace_back(c, f);
        }
      return faces;
    }



    /** Parts into which cut faces divide the cells around a node: cells of a
     * part are connected by uncut faces at the node. */
    std::vector<std::vector<std::size_t>>
    parts_around(const std::vector<std::size_t> &around,
                 const std::vector<Nodes>       &uncut_faces,
                 const Faces                    &faces)
    {
      std::map<std::size_t, std::size_t> part_of; // parent of each cell
      for (const std::size_t cell : around)
        part_of[cell] = cell;
      const auto root = [&](std::size_t cell) {
        while (part_of[cell] != cell)
          cell = part_of[cell];
        return cell;
      };
      for (const Nodes &face : uncut_faces)
        if (const auto &sides = faces.at(face); sides.size() == 2)
          part_of[root(sides[1].first)] = root(sides[0].first);
      std::map<std::size_t, std::vector<std::size_t>> parts;
      for (const std::size_t cell : around)
        parts[root(cell)].push_back(cell);
      std::vector<std::vector<std::size_t>> list;
      for (const auto &[first, part] : parts)
        list.push_back(part);
      return list;
    }



    /** Nodes of boundary elements of these groups between two cells. */
    std::set<Nodes>
    find_cuts(const std::set<unsigned int>   &groups,
              const std::vector<MeshElement> &boundary,
              const Faces                    &faces)
    {
      std::set<Nodes> cuts;
      for (const MeshElement &element : boundary)
        if (const auto face = faces.find(sorted_nodes(element.nodes));
            groups.count(element.group) > 0 && face != faces.end() &&
            face->second.size() == 2)
          cuts.insert(face->first);
      return cuts;
    }



    void
    double_nodes(const std::set<Nodes> &cuts,
                 const Faces           &faces,
                 GmshMesh              &mesh)
    {
      std::map<std::size_t, std::vector<std::size_t>> cells_at;
      std::map<std::size_t, std::vector<Nodes>>       uncut_faces;
      for (const Nodes &cut : cuts)
        for (const std::size_t node : cut)
          uncut_faces[node]; // even if it has none
      for (std::size_t c = 0; c < mesh.cells.size(); ++c)
        for (const std::size_t node : mesh.cells[c].nodes)
          if (uncut_faces.count(node) > 0)
            cells_at[node].push_back(c);
      for (const auto &[face, places] : faces)
        if (cuts.count(face) == 0)
          for (const std::size_t node : face)
            if (const auto at = uncut_faces.find(node); at != uncut_faces.end())
              at->second.push_back(face);

      for (const auto &[node, around] : uncut_faces)
        {
          const auto parts = parts_around(cells_at.at(node), around, faces);
          for (std::size_t p = 1; p < parts.size(); ++p)
            {
              const std::size_t twin = mesh.nodes.rbegin()->first + 1;
              mesh.nodes[twin]       = mesh.nodes.at(node);
              for (const std::size_t c : parts[p])
                std::replace(mesh.cells[c].nodes.begin(),
                             mesh.cells[c].nodes.end(),
                             node,
                             twin);
            }
        }
    }



    /** Checks that each element of a crack has doubled nodes. @throw SceneError
     * if the crack ends at all nodes of an element. */
    void
    require_opening(const std::set<Nodes> &cuts,
                    const Faces           &faces,
                    const GmshMesh        &mesh)
    {
      for (const MeshElement &element : mesh.boundary)
        if (cuts.count(sorted_nodes(element.nodes)) > 0)
          {
            const auto &sides = faces.at(sorted_nodes(element.nodes));
            const auto  lip   = [&](const CellFace &side) {
              return sorted_nodes(
                nodes_of_faces(mesh.cells[side.first])[side.second]);
            };
            if (lip(sides[0]) != lip(sides[1]))
              continue;
            const auto n = std::count_if(mesh.boundary.begin(),
                                         mesh.boundary.end(),
                                         [&](const MeshElement &other) {
                                           return other.group == element.group;
                                         });
            throw SceneError(
              "the crack of the physical group " +
              std::to_string(element.group) + ", which has " +
              std::to_string(n) + (n == 1 ? " element" : " elements") +
              ", cannot open at element " + std::to_string(element.number) +
              ", because the crack ends at all nodes of this element; refine "
              "the mesh along the crack to at least two elements in each "
              "direction");
          }
    }



    /** Boundary elements with the new nodes of their cells, one element for
     * either side of a cut. */
    std::vector<MeshElement>
    boundary_of(const GmshMesh        &mesh,
                const std::set<Nodes> &cuts,
                const Faces           &faces)
    {
      std::vector<MeshElement> boundary;
      for (const MeshElement &element : mesh.boundary)
        if (const auto face = faces.find(sorted_nodes(element.nodes));
            face == faces.end() ||
            (face->second.size() > 1 && cuts.count(face->first) == 0))
          boundary.push_back(element); // check_faces() reports it
        else
          for (const auto &[c, f] : face->second)
            boundary.push_back({element.number,
                                element.group,
                                nodes_of_faces(mesh.cells[c])[f]});
      return boundary;
    }



    /** Adds the middles of edges whose nodes were doubled. */
    void
    add_middles(const std::vector<MeshElement> &uncut, GmshMesh &mesh)
    {
      const std::map<EdgeNodes, std::size_t> before(mesh.middles);
      for (std::size_t c = 0; c < uncut.size(); ++c)
        for (std::size_t i = 0; i < uncut[c].nodes.size(); ++i)
          for (std::size_t j = 0; j < i; ++j)
            if (const auto middle = before.find(
                  std::minmax({uncut[c].nodes[i], uncut[c].nodes[j]}));
                middle != before.end())
              mesh.middles[std::minmax(
                {mesh.cells[c].nodes[i], mesh.cells[c].nodes[j]})] =
                middle->second;
    }
  } // namespace



  void
  cut_cracks(const std::set<unsigned int> &groups, GmshMesh &mesh)
  {
    if (groups.empty())
      return;
    const std::vector<MeshElement> uncut = mesh.cells;
    const Faces                    faces = faces_of(uncut);
    const std::set<Nodes> cuts = find_cuts(groups, mesh.boundary, faces);
    double_nodes(cuts, faces, mesh);
    require_opening(cuts, faces, mesh);
    mesh.boundary = boundary_of(mesh, cuts, faces);
    add_middles(uncut, mesh);
  }
} // namespace Crevasse
