// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/discretisation/rigid_modes.h>

#include <deal.II/base/bounding_box.h>
#include <deal.II/base/function.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/numerics/vector_tools.h>

namespace Crevasse
{
  using namespace dealii;

  namespace
  {
    /** One mode as a function of the place. */
    template <int dim>
    class RigidMode : public Function<dim>
    {
    public:
      RigidMode(const unsigned int mode, const BoundingBox<dim> &box)
        : Function<dim>(dim)
        , mode(mode)
        , origin(box.center())
        , length(box.get_boundary_points().first.distance(
            box.get_boundary_points().second))
      {
      }

      double
      value(const Point<dim> &x, const unsigned int component) const override
      {
        return rigid_mode<dim>(mode,
                               component,
                               Point<dim>((x - origin) / length));
      }

    private:
      const unsigned int mode;
      const Point<dim>   origin;
      const double       length;
    };
  } // namespace



  template <int dim>
  double
  rigid_mode(const unsigned int m, const unsigned int c, const Point<dim> &x)
  {
    if (m < dim)
      return m == c ? 1. : 0.;
    // Rotation in the plane (a,b): (12) in 2D; (12), (13), (23) in 3D.
    const unsigned int a = (m - dim == 2 ? 1 : 0);
    const unsigned int b = (m - dim == 0 ? 1 : 2);
    return c == a ? -x[b] : (c == b ? x[a] : 0.);
  }



  template <int dim>
  std::vector<Vector>
  rigid_modes(const Space<dim> &space)
  {
    // Every rank knows the coarse mesh, so that all have the same box.
    std::vector<Point<dim>> vertices;
    for (const auto &cell : space.mesh().cell_iterators_on_level(0))
      for (const unsigned int v : cell->vertex_indices())
        vertices.push_back(cell->vertex(v));
    const BoundingBox<dim> box(vertices);
    IndexSet               relevant;
    DoFTools::extract_locally_relevant_dofs(space.dof_handler(), relevant);
    std::vector<Vector> modes(n_rigid_modes<dim>,
                              Vector(space.dof_handler().locally_owned_dofs(),
                                     relevant,
                                     space.communicator()));
    for (unsigned int m = 0; m < modes.size(); ++m)
      VectorTools::interpolate(space.mapping(),
                               space.dof_handler(),
                               RigidMode<dim>(m, box),
                               modes[m]);
    return modes;
  }



  template double
  rigid_mode<2>(const unsigned int, const unsigned int, const Point<2> &);
  template double
  rigid_mode<3>(const unsigned int, const unsigned int, const Point<3> &);
  template std::vector<Vector>
  rigid_modes<2>(const Space<2> &);
  template std::vector<Vector>
  rigid_modes<3>(const Space<3> &);
} // namespace Crevasse
