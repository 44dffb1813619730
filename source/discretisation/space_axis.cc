// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/collectively.h>
#include <crevasse/base/problems.h>
#include <crevasse/base/text.h>
#include <crevasse/discretisation/space.h>

#include <deal.II/numerics/vector_tools.h>

namespace Crevasse
{
  using namespace dealii;

  template <int dim>
  void
  Space<dim>::hold_axis()
  {
    if (!roles.has_axis)
      return;
    const auto                          &fe = finite_element;
    FEValues<dim>                        support(mapping,
                          fe,
                          Quadrature<dim>(fe.get_unit_support_points()),
                          update_quadrature_points);
    std::vector<types::global_dof_index> dofs(fe.n_dofs_per_cell());
    collectively(communicator(), [&]() {
      for (const auto &cell : dof_handler.active_cell_iterators())
        if (!cell->is_artificial())
          {
            const double rounding = 1e-8 * cell->diameter();
            support.reinit(cell);
            cell->get_dof_indices(dofs);
            for (unsigned int i = 0; i < dofs.size(); ++i)
              {
                const Point<dim> &point = support.quadrature_point(i);
                if (point[0] < -rounding)
                  throw SceneError(
                    "[Material] Plane state = axisymmetric: x is the radius "
                    "and must not be negative, but the mesh has the node " +
                    Text::from_point(point) +
                    ". Move the mesh, so that the axis is at x = 0.");
                if (fe.system_to_component_index(i).first == 0 &&
                    point[0] < rounding &&
                    !supports_and_hanging.is_constrained(dofs[i]))
                  supports_and_hanging.add_line(dofs[i]);
              }
          }
    });
  }



  template <int dim>
  void
  Space<dim>::hold_boundaries()
  {
    std::set<types::boundary_id> ids = roles.clamped;
    ids.insert(roles.displaced.begin(), roles.displaced.end());
    for (const auto id : ids)
      {
        ComponentMask mask(dim, true);
        for (unsigned int d = 0; d < dim; ++d)
          mask.set(d, roles.free.count({id, d}) == 0);
        VectorTools::interpolate_boundary_values(mapping,
                                                 dof_handler,
                                                 id,
                                                 Functions::ZeroFunction<dim>(
                                                   dim),
                                                 supports_and_hanging,
                                                 mask);
      }
  }



  template void
  Space<2>::hold_axis();
  template void
  Space<3>::hold_axis();
  template void
  Space<2>::hold_boundaries();
  template void
  Space<3>::hold_boundaries();
} // namespace Crevasse
