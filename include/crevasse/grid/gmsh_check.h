// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_grid_gmsh_check_h
#define crevasse_grid_gmsh_check_h

#include <crevasse/base/file_words.h>
#include <crevasse/grid/mesh_faces.h>

#include <array>
#include <map>
#include <string>
#include <unordered_set>

namespace Crevasse
{
  /** What to say of a mesh that has other cells than quadrilaterals
   * (hexahedra). */
  std::string
  only_hypercubes(const unsigned int dim);

  /**
   * Reads the text of a Gmsh file (formats 2 and 4, ASCII) for nothing but
   * what is wrong with it. deal.II's reader believes the file: where counts,
   * numbers of nodes or faces contradict each other it writes beyond its
   * arrays, or returns another mesh than was meant.
   */
  class GmshCheck
  {
  public:
    GmshCheck(const std::string &text, const unsigned int dim)
      : words(text)
      , dim(dim)
    {
    }

    /** @throw SceneError with line and value, "line 7: ...". */
    void
    check();

  private:
    void
    check_format();

    void
    check_entities();

    void
    check_entity(const int entity_dim);

    void
    check_nodes();

    void
    check_block_of_nodes();

    void
    check_node_number();

    void
    check_coordinates();

    void
    check_elements();

    /** Returns how many elements it has. */
    int
    check_block_of_elements();

    /** Before format 4, where each element has its type and tags. */
    void
    check_tagged_element();

    void
    check_nodes_of_element(const int type, const int physical_group);

    unsigned int
    n_nodes_of(const int type) const;

    void
    check_total(const std::string &what,
                const std::size_t  n,
                const int          n_announced) const;

    int
    read_count(const std::string &what)
    {
      return words.integer("the number of " + what, 0);
    }

    void
    skip_integers(const int n, const std::string &what)
    {
      for (int i = 0; i < n; ++i)
        words.integer(what);
    }

    /** Nodes and elements of one entity of the geometry make a block. */
    bool
    has_blocks() const
    {
      return format >= 4.;
    }

    FileWords          words;
    const unsigned int dim;
    double             format = 0.;
    /** Of the entities of each dimension by their number. */
    std::array<std::map<int, int>, 4> physical_groups;
    std::unordered_set<int>           nodes;
    MeshFaces                         faces;
  };
} // namespace Crevasse

#endif
