// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/grid/gmsh_check.h>

#include <utility>
#include <vector>

namespace Crevasse
{
  namespace
  {
    /** Gmsh's numbers. */
    enum ElementType : int
    {
      line_element          = 1,
      triangle_element      = 2,
      quadrilateral_element = 3,
      tetrahedron_element   = 4,
      hexahedron_element    = 5,
      prism_element         = 6,
      pyramid_element       = 7,
      point_element         = 15
    };
  } // namespace



  void
  GmshCheck::check_elements()
  {
    const int n_blocks   = has_blocks() ? read_count("blocks of elements") : 1;
    const int n_elements = read_count("elements");
    if (format > 4.)
      skip_integers(2, "the number of an element");

    if (!has_blocks())
      {
        for (int i = 0; i < n_elements; ++i)
          check_tagged_element();
        return;
      }
    std::size_t n_found = 0;
    for (int block = 0; block < n_blocks; ++block)
      n_found += check_block_of_elements();
    check_total("elements", n_found, n_elements);
  }



  int
  GmshCheck::check_block_of_elements()
  {
    int entity_dim = 0, entity = 0;
    // Format 4.1 exchanged them.
    for (int *value : {&entity_dim, &entity})
      *value = words.integer("the number or dimension of an entity");
    if (format == 4.)
      std::swap(entity_dim, entity);
    if (entity_dim < 0 || entity_dim > 3)
      words.refuse("an entity has " + std::to_string(entity_dim) +
                   " dimensions; 0 to 3 are possible");
    const auto &groups         = physical_groups[entity_dim];
    const auto  group          = groups.find(entity);
    const int   physical_group = group == groups.end() ? 0 : group->second;

    const int type       = words.integer("the type of elements");
    const int n_elements = read_count("elements of the block");
    for (int i = 0; i < n_elements; ++i)
      {
        words.integer("the number of an element");
        check_nodes_of_element(type, physical_group);
      }
    return n_elements;
  }



  void
  GmshCheck::check_tagged_element()
  {
    words.integer("the number of an element", 0);
    const int type   = words.integer("the type of an element");
    const int n_tags = read_count("tags");
    const int physical_group =
      n_tags > 0 ? words.integer("a physical group", 0) : 0;
    skip_integers(n_tags - 1, "a tag");
    check_nodes_of_element(type, physical_group);
  }



  void
  GmshCheck::check_nodes_of_element(const int type, const int physical_group)
  {
    const unsigned int line = words.line();
    std::vector<int>   element(n_nodes_of(type));
    for (int &node : element)
      {
        node = words.integer("the number of a node", 0);
        if (nodes.count(node) == 0)
          words.refuse("an element has the node " + std::to_string(node) +
                       ", which is not among the nodes");
      }
    const std::unordered_set<int> different(element.begin(), element.end());
    if (different.size() < element.size())
      words.refuse("a node occurs twice in an element");

    const int cell = dim == 2 ? quadrilateral_element : hexahedron_element;
    const int face = dim == 2 ? line_element : quadrilateral_element;
    if (type == cell)
      faces.add_cell(element, line);
    else if (type == face)
      faces.add_boundary(element, physical_group, line);
  }



  unsigned int
  GmshCheck::n_nodes_of(const int type) const
  {
    switch (type)
      {
        case point_element:
          return 1;
        case line_element:
          return 2;
        case quadrilateral_element:
          return 4;
        case hexahedron_element:
          if (dim == 3)
            return 8;
          break;
        case triangle_element:
          words.refuse(only_hypercubes(dim));
        case tetrahedron_element:
        case prism_element:
        case pyramid_element:
          if (dim == 3)
            words.refuse(only_hypercubes(dim));
          break;
      }
    words.refuse("the element type " + std::to_string(type) +
                 " is not allowed with Dimension = " + std::to_string(dim) +
                 "; allowed are points (15), lines (1), quadrilaterals (3)" +
                 (dim == 3 ? ", hexahedra (5)" : "") +
                 " (Gmsh: Mesh.ElementOrder = 1)");
  }
} // namespace Crevasse
