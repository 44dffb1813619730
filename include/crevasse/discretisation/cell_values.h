// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_discretisation_cell_values_h
#define crevasse_discretisation_cell_values_h

#include <crevasse/discretisation/space.h>

#include <deal.II/hp/fe_values.h>

namespace Crevasse
{
  /** Shape functions at the points of each cell's quadrature rule. */
  template <int dim>
  class CellValues
  {
  public:
    /** @param space Must outlive the CellValues. */
    CellValues(const Space<dim> &space, const dealii::UpdateFlags flags)
      : space(space)
      , mapping(space.mapping)
      , finite_element(space.finite_element)
      , values(mapping, finite_element, space.quadratures, flags)
    {
    }

    /** Values of a cell, valid until the next call. */
    const dealii::FEValues<dim> &
    reinit(const typename dealii::DoFHandler<dim>::active_cell_iterator &cell)
    {
      values.reinit(cell, space.rule(cell), 0, 0);
      return values.get_present_fe_values();
    }

  private:
    const Space<dim>                        &space;
    const dealii::hp::MappingCollection<dim> mapping;
    const dealii::hp::FECollection<dim>      finite_element;
    dealii::hp::FEValues<dim>                values;
  };

  /** Calls f(values, q, p) for point q of each cell of this rank, where p is
   * the number of the point in a QuadratureField. */
  template <int dim, typename Function>
  void
  for_each_point(const Space<dim>         &space,
                 const dealii::UpdateFlags flags,
                 const Function           &f)
  {
    CellValues<dim> cell_values(space, flags);
    std::size_t     p = 0;
    for (const auto &cell : owned_cells(space.dof_handler))
      {
        const dealii::FEValues<dim> &values = cell_values.reinit(cell);
        for (const unsigned int q : values.quadrature_point_indices())
          f(values, q, p++);
      }
  }
} // namespace Crevasse

#endif
