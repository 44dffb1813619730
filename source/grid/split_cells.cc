// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/grid/curved_edges.h>
#include <crevasse/grid/element_parts.h>
#include <crevasse/grid/split_cells.h>

#include <algorithm>

namespace Crevasse
{
  using namespace dealii;

  namespace
  {
    using Nodes = std::vector<std::size_t>;



    /** Edges that are divided: those of triangles and tetrahedra, and in a
     * quadrilateral the edge opposite to a divided one. */
    class DividedEdges
    {
    public:
      DividedEdges(const unsigned int              dim,
                   const std::vector<MeshElement> &cells)
      {
        for (const MeshElement &cell : cells)
          for (const Nodes &polygon : polygons_of(cell.nodes, dim))
            if (polygon.size() == 4)
              for (const unsigned int i : {0, 1})
                parent[root(edge(polygon, i))] = root(edge(polygon, i + 2));
        for (const MeshElement &cell : cells)
          for (const Nodes &polygon : polygons_of(cell.nodes, dim))
            if (polygon.size() == 3)
              for (const unsigned int i : {0, 1, 2})
                divided.insert(root(edge(polygon, i)));
      }

      bool
      contains(const std::size_t a, const std::size_t b)
      {
        return divided.count(root(std::minmax(a, b))) > 0;
      }

    private:
      static EdgeNodes
      edge(const Nodes &polygon, const unsigned int i)
      {
        return std::minmax(polygon[i], polygon[(i + 1) % polygon.size()]);
      }

      /** The cell in the plane, or the faces of a cell. */
      static std::vector<Nodes>
      polygons_of(const Nodes &nodes, const unsigned int dim)
      {
        static const std::vector<Nodes> tetrahedron = {{0, 1, 2},
                                                       {0, 1, 3},
                                                       {1, 2, 3},
                                                       {0, 2, 3}},
                                        wedge       = {{0, 1, 2},
                                                       {3, 4, 5},
                                                       {0, 1, 4, 3},
                                                       {1, 2, 5, 4},
                                                       {2, 0, 3, 5}};
        if (dim == 2)
          return {nodes};
        if (nodes.size() == 8)
          return nodes_of_faces({0, 0, nodes});
        std::vector<Nodes> faces = nodes.size() == 4 ? tetrahedron : wedge;
        for (Nodes &face : faces)
          for (std::size_t &node : face)
            node = nodes[node];
        return faces;
      }

      /** Representative of the edges that are divided together. */
      EdgeNodes
      root(const EdgeNodes &edge)
      {
        EdgeNodes top = edge;
        for (auto next = parent.find(top);
             next != parent.end() && next->second != top;
             next = parent.find(top))
          top = next->second;
        if (top != edge)
          parent[edge] = top; // a shorter way
        return top;
      }

      std::map<EdgeNodes, EdgeNodes> parent;
      std::set<EdgeNodes>            divided;
    };



    /** Map of an element: linear in its vertices, and of second order in its
     * edges with middles. */
    class ElementMap
    {
    public:
      ElementMap(const MeshElement                      &element,
                 const unsigned int                      element_dim,
                 const std::map<std::size_t, Point<3>>  &nodes,
                 const std::map<EdgeNodes, std::size_t> &middles)
      {
        for (const std::size_t node : element.nodes)
          vertices.push_back(nodes.at(node));
        const unsigned int n             = vertices.size();
        const auto         is_in_simplex = [&](const unsigned int i,
                                       const unsigned int j,
                                       const unsigned int k) {
          return k == i || k == j || n == 3 || (n == 4 && element_dim == 3) ||
                 (n == 6 && i / 3 == j / 3 && k / 3 == i / 3);
        };
        for (unsigned int i = 0; i < n; ++i)
          for (unsigned int j = 0; j < i; ++j)
            if (const auto middle =
                  middles.find(std::minmax(element.nodes[i], element.nodes[j]));
                middle != middles.end())
              {
                curved.push_back({i, j, nodes.at(middle->second), {}});
                for (unsigned int k = 0; k < n; ++k)
                  if (is_in_simplex(i, j, k))
                    curved.back().simplex.push_back(k);
              }
      }

      bool
      is_curved() const
      {
        return !curved.empty();
      }

      /** Point of the mean of sets of vertices. */
      Point<3>
      mean(const std::vector<Corners> &sets) const
      {
        std::vector<double> weights(vertices.size(), 0.);
        for (const Corners &set : sets)
          for (const unsigned int corner : set)
            weights[corner] += 1. / (set.size() * sets.size());
        Point<3> point;
        for (unsigned int k = 0; k < vertices.size(); ++k)
          point += weights[k] * vertices[k];
        const Edge *on_edge = nullptr;
        for (const Edge &edge : curved)
          {
            const double a = weights[edge.i], b = weights[edge.j];
            if (a * b == 0.)
              continue;
            if (a + b > 1. - 1e-12)
              on_edge = &edge;
            double sum = 0.; // of the vertices of the simplex of the edge
            for (const unsigned int k : edge.simplex)
              sum += weights[k];
            point +=
              4. * a * b / sum *
              (edge.middle - 0.5 * (vertices[edge.i] + vertices[edge.j]));
          }
        return on_edge == nullptr ? point
                                  : project_to_arc(vertices[on_edge->i],
                                                   vertices[on_edge->j],
                                                   on_edge->middle,
                                                   point);
      }

    private:
      struct Edge
      {
        unsigned int              i, j;
        Point<3>                  middle;
        std::vector<unsigned int> simplex; ///< whose edge it is, by vertices
      };

      std::vector<Point<3>> vertices;
      std::vector<Edge>     curved;
    };



    /** Replaces elements by their parts, with new nodes. */
    class Splitter
    {
    public:
      Splitter(const unsigned int dim, GmshMesh &mesh)
        : edges(dim, mesh.cells)
        , mesh(mesh)
        , given(mesh.middles)
      {
      }

      std::vector<MeshElement>
      split(const std::vector<MeshElement> &elements,
            const unsigned int              element_dim)
      {
        std::vector<MeshElement> all;
        for (const MeshElement &element : elements)
          {
            const ElementMap map(element, element_dim, mesh.nodes, given);
            const auto       is_divided = [&](const unsigned int a,
                                        const unsigned int b) {
              return edges.contains(element.nodes[a], element.nodes[b]);
            };
            for (const ElementPart &part : parts_of_element(
                   element_dim, element.nodes.size(), is_divided))
              {
                all.push_back({element.number, element.group, {}});
                for (const Corners &corners : part)
                  all.back().nodes.push_back(node_of(corners, element, map));
                if (map.is_curved())
                  add_middles(all.back(), part, map);
              }
          }
        return all;
      }

    private:
      std::size_t
      add_node(const Point<3> &point)
      {
        const std::size_t number = mesh.nodes.rbegin()->first + 1;
        mesh.nodes[number]       = point;
        return number;
      }

      /** Node at the mean of corners, which all their elements share. */
      std::size_t
      node_of(const Corners     &corners,
              const MeshElement &element,
              const ElementMap  &map)
      {
        Nodes nodes;
        for (const unsigned int corner : corners)
          nodes.push_back(element.nodes[corner]);
        if (nodes.size() == 1)
          return nodes[0];
        std::sort(nodes.begin(), nodes.end());
        const auto place = new_nodes.find(nodes);
        return place != new_nodes.end()
                 ? place->second
                 : new_nodes[nodes] = add_node(map.mean({corners}));
      }

      /** Adds the middles of curved edges of a part, and some between other
       * vertices, which nothing uses. */
      void
      add_middles(const MeshElement &part,
                  const ElementPart &corners,
                  const ElementMap  &map)
      {
        for (std::size_t i = 0; i < corners.size(); ++i)
          for (std::size_t j = 0; j < i; ++j)
            {
              const EdgeNodes edge = std::minmax(part.nodes[i], part.nodes[j]);
              const Point<3> &a    = mesh.nodes.at(edge.first),
                             &b    = mesh.nodes.at(edge.second);
              const Point<3>   middle   = map.mean({corners[i], corners[j]});
              constexpr double straight = 1e-7;
              if (middle.distance(a + 0.5 * (b - a)) >
                    straight * a.distance(b) &&
                  mesh.middles.count(edge) == 0)
                mesh.middles[edge] = add_node(middle);
            }
      }

      DividedEdges                           edges;
      GmshMesh                              &mesh;
      const std::map<EdgeNodes, std::size_t> given;     ///< middles of the file
      std::map<Nodes, std::size_t>           new_nodes; ///< by what they divide
    };
  } // namespace



  std::string
  split_cells(const unsigned int dim, GmshMesh &mesh)
  {
    const auto is_divided = [dim](const MeshElement &cell) {
      return cell.nodes.size() != std::size_t(1) << dim;
    };
    const auto n =
      std::count_if(mesh.cells.begin(), mesh.cells.end(), is_divided);
    if (n == 0)
      return "";
    Splitter splitter(dim, mesh);
    mesh.boundary = splitter.split(mesh.boundary, dim - 1);
    mesh.cells    = splitter.split(mesh.cells, dim);
    return std::to_string(n) +
           (dim == 2 ? " triangles" : " tetrahedra or wedges") +
           " divided: " + std::to_string(mesh.cells.size()) +
           (dim == 2 ? " quadrilaterals" : " hexahedra");
  }
} // namespace Crevasse
