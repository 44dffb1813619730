// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/checkpoint/field_archive.h>

#include <deal.II/base/mpi.h>

namespace Crevasse
{
  using namespace dealii;

  template <int dim>
  FieldArchive<dim>::FieldArchive(CommonArchive            &&common,
                                  const CellwiseFields<dim> &fields,
                                  FieldStore                &store)
    : CommonArchive(std::move(common))
    , fields(fields)
    , store(store)
  {
  }



  template <int dim>
  bool
  FieldArchive<dim>::is_there(const std::size_t size)
  {
    int there = size > 0 ? 1 : 0;
    if (!is_loading())
      there = Utilities::MPI::max(there, communicator());
    common(there);
    return there == 1;
  }



  template <int dim>
  void
  FieldArchive<dim>::nodal(Vector &field)
  {
    if (!is_there(field.size()))
      return;
    std::vector<double> values, singular;
    if (!is_loading())
      {
        values   = fields.nodal(field);
        singular = fields.singular_coefficients(field);
      }
    store.of_cells(fields.n_nodal_values(), values);
    common(singular);
    if (is_loading())
      {
        fields.set_nodal(values, field);
        fields.set_singular_coefficients(singular, field);
      }
  }



  template <int dim>
  void
  FieldArchive<dim>::at_points(Vector &field)
  {
    if (!is_there(field.size()))
      return;
    unsigned int        n = 0;
    std::vector<double> values;
    if (!is_loading())
      {
        n      = fields.n_per_point(field);
        values = fields.at_points(field);
      }
    common(n);
    store.of_points(n, values);
    if (is_loading())
      fields.set_at_points(values, n, field);
  }



  template <int dim>
  void
  FieldArchive<dim>::on_bounds(std::vector<double> &values)
  {
    if (!is_there(values.size()))
      return;
    Vector field = fields.from_bounds(values);
    nodal(field);
    if (is_loading())
      values = fields.to_bounds(field);
  }



  template <int dim>
  void
  FieldArchive<dim>::on_cells(dealii::Vector<double> &values)
  {
    std::vector<double> ordered = fields.of_cells(values);
    store.of_cells(1, ordered);
    if (is_loading())
      fields.set_of_cells(ordered, values);
  }



  template class FieldArchive<2>;
  template class FieldArchive<3>;
} // namespace Crevasse
