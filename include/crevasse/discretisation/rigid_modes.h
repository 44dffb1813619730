// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_discretisation_rigid_modes_h
#define crevasse_discretisation_rigid_modes_h

#include <crevasse/discretisation/space.h>

#include <deal.II/base/bounding_box.h>

namespace Crevasse
{
  /**
   * Connected parts of a mesh, each of which may move as a rigid body: cells
   * that share a face belong to the same part. A motion of all parts has the
   * coefficient of mode m of part p at the index p n_modes + m.
   */
  template <int dim>
  class RigidParts
  {
  public:
    explicit RigidParts(const dealii::Triangulation<dim> &mesh);

    static constexpr unsigned int n_modes = dim * (dim + 1) / 2;

    const dealii::BoundingBox<dim> body;
    unsigned int                   n_parts;

    /** Length that scales coordinates, so that modes have unit size. */
    double
    size() const
    {
      const auto &corners = body.get_boundary_points();
      return corners.first.distance(corners.second);
    }

    /** Number of the part of a cell of any level. */
    unsigned int
    part(typename dealii::Triangulation<dim>::cell_iterator cell) const
    {
      while (cell->level() > 0)
        cell = cell->parent();
      return of_coarse_cell[cell->index()];
    }

    /** Component @p c at @p x of the rigid-body mode @p m: first translations,
     * then rotations in the planes 12, 13, 23 about the middle of the body. */
    double
    mode(const unsigned int        m,
         const unsigned int        c,
         const dealii::Point<dim> &x) const;

    /** Displacement of a motion at the degrees of freedom of this rank,
     * ignoring constraints. */
    Vector
    displacement(const Space<dim>          &space,
                 const std::vector<double> &motion) const;

  private:
    std::vector<unsigned int> of_coarse_cell;
  };

  /** Rigid-body modes as displacement vectors: translations and infinitesimal
   * rotations about the middle of the body, of unit size, three in the plane,
   * six in space. Ignores constraints. */
  template <int dim>
  std::vector<Vector>
  rigid_modes(const Space<dim> &space);
} // namespace Crevasse

#endif
