// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/problems.h>
#include <crevasse/base/text.h>
#include <crevasse/grid/gmsh_elements.h>

#include <algorithm>
#include <gmsh.h>
#include <optional>

namespace Crevasse
{
  namespace
  {
    /** Reads the middle nodes of the edges of elements of second order. If
     * several nodes have the same position, as where lips with separate nodes
     * meet at a front, one of them is stored: only its position matters. */
    void
    read_middles(const int                       type,
                 const int                       entity,
                 const std::vector<std::size_t> &numbers,
                 GmshMesh                       &mesh)
    {
      std::vector<std::size_t> nodes; // two ends and the middle of each edge
      gmsh::model::mesh::getElementEdgeNodes(type, nodes, entity);
      for (std::size_t k = 0; k < nodes.size(); k += 3)
        {
          const EdgeNodes edge  = std::minmax(nodes[k], nodes[k + 1]);
          const auto     &place = mesh.nodes.at(nodes[k + 2]);
          const auto     &other = mesh.nodes.at(
            mesh.middles.emplace(edge, nodes[k + 2]).first->second);
          const double length =
            mesh.nodes.at(edge.first).distance(mesh.nodes.at(edge.second));
          if (place.distance(other) > 1e-6 * length)
            throw SceneError(
              "element " +
              std::to_string(numbers[k * numbers.size() / nodes.size()]) +
              ": between the nodes " + std::to_string(edge.first) + " and " +
              std::to_string(edge.second) +
              " another element has a different node, at " +
              Text::from_point(other) + " instead of " +
              Text::from_point(place));
        }
    }



    /** Name of an entity of Gmsh in messages. */
    std::string
    name_of(const std::pair<int, int> &entity)
    {
      return (entity.first == 1   ? "curve "
              : entity.first == 2 ? "surface "
                                  : "volume ") +
             std::to_string(entity.second);
    }



    /** Physical groups of an entity. */
    Groups
    groups_of(const std::pair<int, int> &entity, const GmshMesh &mesh)
    {
      std::vector<int> groups = {entity.second};
      if (!mesh.entities_are_groups)
        gmsh::model::getPhysicalGroupsForEntity(entity.first,
                                                entity.second,
                                                groups);
      for (const int group : groups)
        if (group < 0)
          throw SceneError(name_of(entity) + " belongs to the physical group " +
                           std::to_string(group) +
                           "; groups must be numbered from 0");
      return {groups.begin(), groups.end()};
    }



    /** A physical group in messages: "outer" (3). */
    std::string
    describe_group(const int dim, const unsigned int group)
    {
      std::string name;
      gmsh::model::getPhysicalName(dim, group, name);
      return (name.empty() ? "" : '"' + name + "\" ") + '(' +
             std::to_string(group) + ')';
    }



    /** Group of an element that may belong to several: one that the scene uses,
     * or else the first; 0 if there is none.
     * @param dim Dimension of the element.
     * @param uses Groups with the same role, or of the same material. */
    unsigned int
    choose_group(const int                  dim,
                 const Groups              &groups,
                 const std::vector<Groups> &uses,
                 const dealii::Point<3>    &place)
    {
      std::optional<unsigned int> chosen;
      for (const Groups &use : uses)
        for (const unsigned int group : use)
          if (groups.count(group) > 0)
            {
              if (chosen && use.count(*chosen) == 0)
                throw SceneError(
                  "the element at " + Text::from_point(place) +
                  " belongs to the physical groups " +
                  describe_group(dim, *chosen) + " and " +
                  describe_group(dim, group) +
                  ", to which the scene gives different roles or materials; "
                  "name groups that have no element in common");
              chosen = chosen.value_or(group);
            }
      return chosen.value_or(groups.empty() ? 0 : *groups.begin());
    }



    /** Number of vertices of an element type.
     * @throw SceneError if the type is not allowed in this dimension. */
    int
    require_allowed(const int          type,
                    const int          element_dim,
                    const unsigned int dim)
    {
      std::string         name;
      int                 its_dim, order, n_nodes, n_vertices = 0;
      std::vector<double> coordinates;
      gmsh::model::mesh::getElementProperties(
        type, name, its_dim, order, n_nodes, coordinates, n_vertices);
      if (order > 2 || element_dim > int(dim))
        throw SceneError(
          "the element type " + std::to_string(type) + " (" + name +
          ") is not allowed with Dimension = " + std::to_string(dim) +
          "; allowed are points, lines, triangles, quadrilaterals" +
          (dim == 3 ? ", tetrahedra, wedges, hexahedra" : "") +
          " of first or second order (Gmsh: Mesh.ElementOrder = 1 or 2)");
      return n_vertices;
    }



    /** An element of the file and all its groups. */
    struct Found
    {
      MeshElement element;
      Groups      groups;
    };



    /** Joins elements with the same vertices: in format 2 an element occurs
     * once for each of its groups. Sorts them by their numbers. */
    void
    join_equal(std::vector<Found> &all)
    {
      std::stable_sort(all.begin(),
                       all.end(),
                       [](const Found &a, const Found &b) {
                         return a.element.number < b.element.number;
                       });
      std::vector<std::pair<std::vector<std::size_t>, std::size_t>> order;
      for (const auto &[element, groups] : all)
        {
          order.emplace_back(element.nodes, order.size());
          std::sort(order.back().first.begin(), order.back().first.end());
        }
      std::sort(order.begin(), order.end());
      for (std::size_t i = 1; i < order.size(); ++i)
        if (order[i].first == order[i - 1].first)
          {
            Found &copy = all[order[i].second];
            all[order[i - 1].second].groups.merge(copy.groups);
            copy.element.nodes.clear();
            order[i].second = order[i - 1].second;
          }
      all.erase(std::remove_if(all.begin(),
                               all.end(),
                               [](const Found &found) {
                                 return found.element.nodes.empty();
                               }),
                all.end());
    }



    /** Checks that all elements of an entity have one order: otherwise Gmsh
     * returns those of one, but counts all. @throw SceneError */
    void
    require_one_order(const int                  type,
                      const std::size_t          n_returned,
                      const std::pair<int, int> &entity)
    {
      std::vector<std::size_t> all, no_nodes;
      gmsh::model::mesh::preallocateElementsByType(
        type, true, false, all, no_nodes, entity.second);
      if (all.size() > n_returned)
        throw SceneError(name_of(entity) +
                         " has elements of first and of second order; all must "
                         "have one (Gmsh: Mesh.ElementOrder = 1 or 2)");
    }



    /** Whether an element has a node twice, or two vertices at one place. */
    bool
    has_collapsed(const std::vector<std::size_t> &nodes,
                  const int                       n_vertices,
                  const GmshMesh                 &mesh)
    {
      std::vector<dealii::Point<3>> places;
      for (int i = 0; i < n_vertices; ++i)
        {
          const auto &place = mesh.nodes.at(nodes[i]);
          if (std::find(places.begin(), places.end(), place) != places.end())
            return true;
          places.push_back(place);
        }
      for (auto node = nodes.begin(); node != nodes.end(); ++node)
        if (std::find(nodes.begin(), node, *node) != node)
          return true;
      return false;
    }



    /** Reads the elements of a type of an entity with their vertices. */
    void
    read_type(const int                       n_vertices,
              const std::pair<int, int>      &entity,
              const std::vector<std::size_t> &numbers,
              const std::vector<std::size_t> &nodes,
              const GmshMesh                 &mesh,
              std::vector<Found>             &all)
    {
      const Groups      groups = groups_of(entity, mesh);
      const std::size_t n      = nodes.size() / numbers.size();
      for (std::size_t i = 0; i < numbers.size(); ++i)
        {
          const std::vector<std::size_t> own(nodes.begin() + i * n,
                                             nodes.begin() + (i + 1) * n);
          const MeshElement              element{numbers[i],
                                    0,
                                    {own.begin(), own.begin() + n_vertices}};
          const auto                     what = [&]() {
            return "element " + std::to_string(numbers[i]) + ", at " +
                   Text::from_point(mesh.nodes.at(own[0])) + ": ";
          };
          if (n_vertices == 5)
            throw SceneError(what() +
                             "pyramids are not implemented; mesh the body with "
                             "tetrahedra alone, or with hexahedra and wedges");
          if (has_collapsed(own, n_vertices, mesh))
            throw SceneError(what() +
                             "a node occurs twice, or two have one place. "
                             "Collapsed cells, as around "
                             "crack tips with quarter-point elements, are not "
                             "implemented; use ordinary cells there, and "
                             "[Discretisation] Singular functions");
          all.push_back({element, groups});
        }
    }
  } // namespace



  std::vector<MeshElement>
  read_gmsh_elements(const int                  element_dim,
                     const unsigned int         dim,
                     const std::vector<Groups> &uses,
                     GmshMesh                  &mesh)
  {
    std::vector<Found>               all;
    std::vector<std::pair<int, int>> entities;
    gmsh::model::getEntities(entities, element_dim);
    for (const auto &entity : entities)
      {
        std::vector<int>                      types;
        std::vector<std::vector<std::size_t>> numbers, nodes;
        gmsh::model::mesh::getElements(
          types, numbers, nodes, entity.first, entity.second);
        for (std::size_t i = 0; i < types.size(); ++i)
          {
            const int n_vertices = require_allowed(types[i], element_dim, dim);
            require_one_order(types[i], numbers[i].size(), entity);
            read_type(n_vertices, entity, numbers[i], nodes[i], mesh, all);
            if (nodes[i].size() > n_vertices * numbers[i].size())
              read_middles(types[i], entity.second, numbers[i], mesh);
          }
      }
    join_equal(all);
    std::vector<MeshElement> elements;
    for (const auto &[element, groups] : all)
      {
        elements.push_back(element);
        elements.back().group = choose_group(element_dim,
                                             groups,
                                             uses,
                                             mesh.nodes.at(element.nodes[0]));
      }
    return elements;
  }
} // namespace Crevasse
