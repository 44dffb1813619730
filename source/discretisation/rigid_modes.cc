// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/discretisation/rigid_modes.h>

#include <deal.II/grid/grid_tools.h>

#include <boost/graph/adjacency_list.hpp>
#include <boost/graph/connected_components.hpp>

namespace Crevasse
{
  using namespace dealii;

  template <int dim>
  RigidParts<dim>::RigidParts(const Triangulation<dim> &mesh)
    : body(GridTools::compute_bounding_box(mesh))
    , of_coarse_cell(mesh.n_cells(0))
  {
    boost::adjacency_list<boost::vecS, boost::vecS, boost::undirectedS>
      neighbors(mesh.n_cells(0));
    for (const auto &cell : mesh.cell_iterators_on_level(0))
      for (const unsigned int f : cell->face_indices())
        if (!cell->at_boundary(f))
          boost::add_edge(cell->index(), cell->neighbor(f)->index(), neighbors);
    n_parts = boost::connected_components(neighbors, of_coarse_cell.data());
  }



  template <int dim>
  double
  RigidParts<dim>::mode(const unsigned int m,
                        const unsigned int c,
                        const Point<dim>  &x) const
  {
    if (m < dim)
      return m == c ? 1. : 0.;
    const unsigned int   a      = (m - dim == 2 ? 1 : 0);
    const unsigned int   b      = (m - dim == 0 ? 1 : 2);
    const Tensor<1, dim> scaled = (x - body.center()) / size();
    return c == a ? -scaled[b] : (c == b ? scaled[a] : 0.);
  }



  template <int dim>
  Vector
  RigidParts<dim>::displacement(const Space<dim>          &space,
                                const std::vector<double> &motion) const
  {
    const FESystem<dim>                 &fe = space.finite_element;
    FEValues<dim>                        support(space.mapping,
                          fe,
                          Quadrature<dim>(fe.get_unit_support_points()),
                          update_quadrature_points);
    std::vector<types::global_dof_index> dofs(fe.n_dofs_per_cell());
    Vector values = make_vector(space.dof_handler);
    for (const auto &cell : owned_cells(space.dof_handler))
      {
        support.reinit(cell);
        cell->get_dof_indices(dofs);
        const unsigned int first = part(cell) * n_modes;
        for (unsigned int i = 0; i < dofs.size(); ++i)
          if (values.in_local_range(dofs[i]))
            {
              const unsigned int c = fe.system_to_component_index(i).first;
              double             u = 0.;
              for (unsigned int m = 0; m < n_modes; ++m)
                u +=
                  motion[first + m] * mode(m, c, support.quadrature_point(i));
              values(dofs[i]) = u;
            }
      }
    return values;
  }



  template <int dim>
  std::vector<Vector>
  rigid_modes(const Space<dim> &space)
  {
    const RigidParts<dim> parts(space.mesh());
    std::vector<Vector>   modes;
    for (unsigned int m = 0; m < parts.n_modes; ++m)
      {
        std::vector<double> motion(parts.n_parts * parts.n_modes);
        for (unsigned int part = 0; part < parts.n_parts; ++part)
          motion[part * parts.n_modes + m] = 1.;
        modes.push_back(parts.displacement(space, motion));
        if (space.lip.n_unknowns > 0)
          modes[m] = space.from_nodal_values(modes[m]);
      }
    return modes;
  }



  template class RigidParts<2>;
  template class RigidParts<3>;
  template decltype(rigid_modes<2>) rigid_modes<2>;
  template decltype(rigid_modes<3>) rigid_modes<3>;
} // namespace Crevasse
