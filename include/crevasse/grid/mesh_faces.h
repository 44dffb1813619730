// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_grid_mesh_faces_h
#define crevasse_grid_mesh_faces_h

#include <array>
#include <vector>

namespace Crevasse
{
  /**
   * Whether the elements of a mesh file fit together. deal.II takes for granted
   * that at most two cells share a face and see its nodes in the same order. It
   * passes over a boundary element that is no face of a cell, and takes any of
   * two boundary ids. Messages name lines of the file.
   */
  class MeshFaces
  {
  public:
    /** All faces of a quadrilateral or hexahedron, given by its nodes in
     * Gmsh's order. */
    void
    add_cell(const std::vector<int> &nodes, const unsigned int line);

    /** A line or quadrilateral of the boundary. */
    void
    add_boundary(const std::vector<int> &nodes,
                 const int               id,
                 const unsigned int      line);

    bool
    has_cells() const;

    /** After the last one was added. @throw SceneError */
    void
    check();

  private:
    struct Face
    {
      /** Sorted, with -1 first if there are only two. */
      std::array<int, 4> nodes;
      /** The one across from the smallest. */
      int          opposite;
      int          boundary_id;
      unsigned int line;
    };

    static Face
    make_face(const std::vector<int> &nodes,
              const int               boundary_id,
              const unsigned int      line);

    /** Of all, in the order in which equal ones are next to each other. */
    static void
    sort(std::vector<Face> &faces);

    void
    check_cells() const;

    void
    check_boundary(const Face &boundary) const;

    void
    check_boundary_ids() const;

    std::vector<Face> of_cells;
    std::vector<Face> of_boundary;
  };
} // namespace Crevasse

#endif
