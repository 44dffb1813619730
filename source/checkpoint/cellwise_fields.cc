// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/checkpoint/cellwise_fields.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <numeric>

namespace Crevasse
{
  using namespace dealii;

  template <int dim>
  CellwiseFields<dim>::CellwiseFields(const Body<dim> &body)
    : body(body)
    , bounds(unilateral_bounds(body.lip, body.space))
  {
    // The name of a cell is the tree of p4est and the way down in it, where
    // children are numbered along the curve.
    std::vector<std::pair<CellId, Cell>> named;
    for (const auto &cell : body.space.dof_handler().active_cell_iterators())
      if (cell->is_locally_owned())
        named.emplace_back(cell->id(), cell);
    std::sort(named.begin(), named.end(), [](const auto &a, const auto &b) {
      return a.first < b.first;
    });
    for (const auto &[name, cell] : named)
      {
        (void)name;
        cells.push_back(cell);
        points.push_back(body.space.quadrature(cell).size());
      }
    const MPI_Comm communicator = body.space.communicator();
    const auto counts = Utilities::MPI::all_gather(communicator, cells.size());
    const auto mine =
      counts.begin() + Utilities::MPI::this_mpi_process(communicator);
    first = std::accumulate(counts.begin(), mine, std::size_t(0));
    total = std::accumulate(counts.begin(), counts.end(), std::size_t(0));
  }



  template <int dim>
  std::size_t
  CellwiseFields<dim>::first_cell() const
  {
    return first;
  }



  template <int dim>
  std::size_t
  CellwiseFields<dim>::n_cells() const
  {
    return cells.size();
  }



  template <int dim>
  std::size_t
  CellwiseFields<dim>::n_cells_of_all_ranks() const
  {
    return total;
  }



  template <int dim>
  const std::vector<std::uint32_t> &
  CellwiseFields<dim>::n_points() const
  {
    return points;
  }



  template <int dim>
  unsigned int
  CellwiseFields<dim>::n_nodal_values() const
  {
    return body.space.finite_element().n_dofs_per_cell();
  }



  template <int dim>
  std::vector<double>
  CellwiseFields<dim>::nodal(const Vector &field) const
  {
    Vector ghosted = body.space.ghosted_vector();
    ghosted.copy_locally_owned_data_from(field);
    ghosted.update_ghost_values();
    std::vector<double>                  values;
    std::vector<types::global_dof_index> dofs(n_nodal_values());
    for (const Cell &cell : cells)
      {
        cell->get_dof_indices(dofs);
        for (const auto dof : dofs)
          values.push_back(ghosted(dof));
      }
    return values;
  }



  template <int dim>
  void
  CellwiseFields<dim>::set_nodal(const std::vector<double> &values,
                                 Vector                    &field) const
  {
    body.strain_operator.initialize(field);
    const IndexSet                      &owned = field.locally_owned_elements();
    std::vector<types::global_dof_index> dofs(n_nodal_values());
    auto                                 value = values.begin();
    for (const Cell &cell : cells)
      {
        cell->get_dof_indices(dofs);
        for (const auto dof : dofs)
          {
            if (owned.is_element(dof))
              field(dof) = *value;
            ++value;
          }
      }
  }



  template <int dim>
  std::vector<double>
  CellwiseFields<dim>::singular_coefficients(const Vector &field) const
  {
    const types::global_dof_index n_nodal = body.space.dof_handler().n_dofs();
    std::vector<double>           values(field.size() - n_nodal);
    for (unsigned int k = 0; k < values.size(); ++k)
      if (field.in_local_range(body.space.singular_unknown(k)))
        values[k] = field(body.space.singular_unknown(k));
    Utilities::MPI::sum(values, body.space.communicator(), values);
    return values;
  }



  template <int dim>
  void
  CellwiseFields<dim>::set_singular_coefficients(
    const std::vector<double> &values,
    Vector                    &field) const
  {
    for (unsigned int k = 0; k < values.size(); ++k)
      if (field.in_local_range(body.space.singular_unknown(k)))
        field(body.space.singular_unknown(k)) = values[k];
  }



  template <int dim>
  unsigned int
  CellwiseFields<dim>::n_per_point(const Vector &field) const
  {
    return field.size() / body.points.n_points();
  }



  template <int dim>
  std::vector<double>
  CellwiseFields<dim>::at_points(const Vector &field) const
  {
    const unsigned int  n = n_per_point(field);
    std::vector<double> values;
    values.reserve(field.locally_owned_size());
    for (std::size_t k = 0; k < cells.size(); ++k)
      {
        const double *begin = field.begin() + body.points.offset(cells[k]) /
                                                n_stress_components<dim> * n;
        values.insert(values.end(), begin, begin + points[k] * n);
      }
    return values;
  }



  template <int dim>
  void
  CellwiseFields<dim>::set_at_points(const std::vector<double> &values,
                                     const unsigned int         n,
                                     Vector                    &field) const
  {
    body.points.initialize(field, n / n_stress_components<dim>);
    auto value = values.begin();
    for (std::size_t k = 0; k < cells.size(); ++k)
      {
        std::copy_n(value,
                    points[k] * n,
                    field.begin() + body.points.offset(cells[k]) /
                                      n_stress_components<dim> * n);
        value += points[k] * n;
      }
  }



  template <int dim>
  std::vector<double>
  CellwiseFields<dim>::of_cells(const dealii::Vector<double> &values) const
  {
    std::vector<double> ordered;
    for (const Cell &cell : cells)
      ordered.push_back(values(cell->active_cell_index()));
    return ordered;
  }



  template <int dim>
  void
  CellwiseFields<dim>::set_of_cells(const std::vector<double> &ordered,
                                    dealii::Vector<double>    &values) const
  {
    values.reinit(body.space.mesh().n_active_cells());
    for (std::size_t k = 0; k < cells.size(); ++k)
      values(cells[k]->active_cell_index()) = ordered[k];
  }



  template <int dim>
  Vector
  CellwiseFields<dim>::from_bounds(const std::vector<double> &values) const
  {
    Vector field;
    body.strain_operator.initialize(field);
    for (std::size_t k = 0; k < values.size(); ++k)
      field(bounds.dofs[k]) = values[k];
    return field;
  }



  template <int dim>
  std::vector<double>
  CellwiseFields<dim>::to_bounds(const Vector &field) const
  {
    std::vector<double> values;
    for (const auto dof : bounds.dofs)
      values.push_back(field(dof));
    return values;
  }



  template class CellwiseFields<2>;
  template class CellwiseFields<3>;
} // namespace Crevasse
