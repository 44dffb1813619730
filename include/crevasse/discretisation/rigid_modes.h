// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_discretisation_rigid_modes_h
#define crevasse_discretisation_rigid_modes_h

#include <crevasse/discretisation/space.h>

#include <deal.II/base/bounding_box.h>

namespace Crevasse
{
  /**
   * The connected parts of a mesh, each of which may move as a rigid body:
   * cells that share a face belong to the same part. A motion of all parts has
   * the coefficient of mode m of part p at the place p n_modes + m.
   */
  template <int dim>
  class RigidParts
  {
  public:
    explicit RigidParts(const dealii::Triangulation<dim> &mesh);

    static constexpr unsigned int n_modes = dim * (dim + 1) / 2;

    const dealii::BoundingBox<dim> body;
    unsigned int                   n_parts;

    /** What coordinates are scaled by, so that modes have unit size. */
    double
    size() const
    {
      const auto &corners = body.get_boundary_points();
      return corners.first.distance(corners.second);
    }

    /** That of a cell of any level. */
    unsigned int
    part(typename dealii::Triangulation<dim>::cell_iterator cell) const
    {
      while (cell->level() > 0)
        cell = cell->parent();
      return of_coarse_cell[cell->index()];
    }

    /** Component @p c at @p x of mode @p m: translations come first, then
     * rotations in the planes 12, 13, 23 about the middle of the body. */
    double
    mode(const unsigned int        m,
         const unsigned int        c,
         const dealii::Point<dim> &x) const;

    /** A motion at the degrees of freedom of this rank, without regard to
     * constraints. */
    Vector
    displacement(const Space<dim>          &space,
                 const std::vector<double> &motion) const;

  private:
    std::vector<unsigned int> of_coarse_cell;
  };

  /** Translations and infinitesimal rotations as displacement vectors, three in
   * the plane, six in space: rotations about the middle of the body and of unit
   * size. Constraints are left out of account. */
  template <int dim>
  std::vector<Vector>
  rigid_modes(const Space<dim> &space);
} // namespace Crevasse

#endif
