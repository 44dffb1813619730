// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/text.h>
#include <crevasse/grid/coincident_faces.h>

#include <algorithm>

namespace Crevasse
{
  using namespace dealii;

  namespace
  {
    using FaceNodes = std::vector<std::size_t>;

    struct SurfaceFace
    {
      FaceNodes nodes;
      Point<3>  centre;
      double    size;
      double    along; ///< coordinate along a line that few faces share
    };



    /** Faces of one cell alone, by the coordinate. */
    std::vector<SurfaceFace>
    surface_of(const GmshMesh &mesh)
    {
      std::map<FaceNodes, std::pair<unsigned int, FaceNodes>> faces;
      for (const MeshElement &cell : mesh.cells)
        for (const FaceNodes &nodes : nodes_of_faces(cell))
          {
            auto &[n_cells, first] = faces[sorted_nodes(nodes)];
            ++n_cells;
            first = nodes;
          }
      const Tensor<1, 3>       line({0.5377, 0.7391, 0.4059});
      std::vector<SurfaceFace> surface;
      for (const auto &[key, face] : faces)
        if (face.first == 1)
          {
            Point<3> centre;
            for (const std::size_t node : key)
              centre += mesh.nodes.at(node) / double(key.size());
            surface.push_back({face.second,
                               centre,
                               centre.distance(mesh.nodes.at(key[0])),
                               centre * line});
          }
      std::sort(surface.begin(),
                surface.end(),
                [](const SurfaceFace &a, const SurfaceFace &b) {
                  return a.along < b.along;
                });
      return surface;
    }



    /** Faces that have a partner with the same centre and size. */
    std::vector<SurfaceFace>
    with_partner(const std::vector<SurfaceFace> &surface)
    {
      constexpr double         tolerance = 1e-6; // of coordinates in files
      std::vector<SurfaceFace> found;
      for (auto face = surface.begin(); face != surface.end(); ++face)
        {
          const double close = tolerance * face->size;
          for (auto other = face + 1;
               other != surface.end() && other->along < face->along + close;
               ++other)
            if (other->centre.distance(face->centre) < close)
              {
                found.push_back(*face);
                found.push_back(*other);
              }
        }
      return found;
    }
  } // namespace



  std::string
  find_coincident_faces(const std::set<unsigned int> &with_role, GmshMesh &mesh)
  {
    const auto faces = with_partner(surface_of(mesh));
    if (faces.empty())
      return "";
    std::map<FaceNodes, std::size_t> index;
    unsigned int                     next = 1; // a number that no group has
    for (std::size_t i = 0; i < mesh.boundary.size(); ++i)
      {
        index[sorted_nodes(mesh.boundary[i].nodes)] = i;
        next = std::max(next, mesh.boundary[i].group + 1);
      }
    std::size_t            n = 0;
    std::set<unsigned int> groups;
    for (const SurfaceFace &face : faces)
      {
        const auto place =
          index.emplace(sorted_nodes(face.nodes), mesh.boundary.size())
            .first->second;
        if (place == mesh.boundary.size())
          mesh.boundary.push_back({0, 0, face.nodes});
        unsigned int &group = mesh.boundary[place].group;
        group               = group == 0 ? next : group;
        if (with_role.count(group) > 0)
          continue;
        ++n;
        groups.insert(group);
      }
    if (n == 0)
      return "";
    std::vector<std::string> numbers;
    for (const unsigned int group : groups)
      numbers.push_back(std::to_string(group));
    return std::to_string(n) +
           " faces on the surface coincide in pairs, as at " +
           Text::from_point(faces[0].centre) +
           ", and have no role: if they are lips, set [Boundary] Crack = " +
           Text::join(numbers, ", ") + "; if not, join the parts there";
  }
} // namespace Crevasse
