// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/text.h>
#include <crevasse/grid/gmsh_check.h>

#include <algorithm>

namespace Crevasse
{
  std::string
  only_hypercubes(const unsigned int dim)
  {
    return dim == 2
             ? "the mesh has triangles; only quadrilaterals are allowed (Gmsh: "
               "Mesh.RecombineAll = 1, Mesh.SubdivisionAlgorithm = 1)."
             : "the mesh has tetrahedra or other cells; only hexahedra are "
               "allowed (Gmsh: Mesh.SubdivisionAlgorithm = 2).";
  }



  void
  GmshCheck::check()
  {
    words.expect("$MeshFormat");
    check_format();
    words.expect("$EndMeshFormat");

    // As deal.II, which knows the sections in this order only.
    if (words.next_is("$PhysicalNames"))
      words.skip_to("$EndPhysicalNames");
    if (words.next_is("$Entities"))
      check_entities();
    if (words.next_is("$PartitionedEntities"))
      words.skip_to("$EndPartitionedEntities");
    words.expect("$Nodes");
    check_nodes();
    words.expect("$EndNodes");
    words.expect("$Elements");
    check_elements();
    words.expect("$EndElements");
    if (!faces.has_cells())
      words.refuse(
        std::string("there are no ") +
        (dim == 2 ? "quadrilaterals" : "hexahedra") +
        ", which are the cells with Dimension = " + std::to_string(dim));
    faces.check();
  }



  void
  GmshCheck::check_format()
  {
    format             = words.number("the format");
    const auto allowed = {2., 2.1, 2.2, 4., 4.1};
    if (std::find(allowed.begin(), allowed.end(), format) == allowed.end())
      words.refuse("the format is " + Text::from_number(format) +
                   "; allowed are 2 and 4 (Gmsh: Mesh.MshFileVersion = 4.1)");
    if (words.integer("the type of the file") != 0)
      words.refuse("the file is not ASCII (Gmsh: Mesh.Binary = 0)");
    if (words.integer("the size of numbers") != 8)
      words.refuse("the size of numbers must be 8");
  }



  void
  GmshCheck::check_entities()
  {
    std::array<int, 4> n_entities;
    for (int &n : n_entities)
      n = read_count("entities");
    for (int entity_dim = 0; entity_dim < 4; ++entity_dim)
      for (int i = 0; i < n_entities[entity_dim]; ++i)
        check_entity(entity_dim);
    words.expect("$EndEntities");
  }



  void
  GmshCheck::check_entity(const int entity_dim)
  {
    const int number = words.integer("the number of an entity");
    // A point has a box around it before format 4.1.
    const int n_coordinates = entity_dim == 0 && format > 4. ? 3 : 6;
    for (int i = 0; i < n_coordinates; ++i)
      words.number("a coordinate");

    const int n_groups = read_count("physical groups");
    if (n_groups > 1)
      words.refuse("an entity belongs to " + std::to_string(n_groups) +
                   " physical groups; each belongs to one at most");
    if (n_groups == 1)
      physical_groups[entity_dim][number] =
        words.integer("a physical group", 0);
    if (entity_dim > 0)
      skip_integers(read_count("entities around an entity"),
                    "the number of an entity");
  }



  void
  GmshCheck::check_nodes()
  {
    const int n_blocks = has_blocks() ? read_count("blocks of nodes") : 1;
    const int n_nodes  = read_count("nodes");
    if (format > 4.)
      skip_integers(2, "the number of a node");

    if (has_blocks())
      for (int block = 0; block < n_blocks; ++block)
        check_block_of_nodes();
    else
      for (int i = 0; i < n_nodes; ++i)
        {
          check_node_number();
          check_coordinates();
        }
    check_total("nodes", nodes.size(), n_nodes);
  }



  void
  GmshCheck::check_block_of_nodes()
  {
    skip_integers(2, "the number or dimension of an entity");
    // deal.II expects two of them, Gmsh writes one to three.
    if (words.integer("0") != 0)
      words.refuse(
        "nodes have parametric coordinates (Gmsh: "
        "Mesh.SaveParametric = 0)");
    const int  n_nodes       = read_count("nodes of the block");
    const bool numbers_first = format > 4.;
    if (numbers_first)
      for (int i = 0; i < n_nodes; ++i)
        check_node_number();
    for (int i = 0; i < n_nodes; ++i)
      {
        if (!numbers_first)
          check_node_number();
        check_coordinates();
      }
  }



  void
  GmshCheck::check_node_number()
  {
    const int number = words.integer("the number of a node", 0);
    if (!nodes.insert(number).second)
      words.refuse("the node " + std::to_string(number) + " occurs twice");
  }



  void
  GmshCheck::check_coordinates()
  {
    for (unsigned int d = 0; d < 3; ++d)
      words.number("a coordinate");
  }



  void
  GmshCheck::check_total(const std::string &what,
                         const std::size_t  n,
                         const int          n_announced) const
  {
    if (n != static_cast<std::size_t>(n_announced))
      words.refuse("there are " + std::to_string(n) + " " + what + ", but " +
                   std::to_string(n_announced) + " are announced");
  }
} // namespace Crevasse
