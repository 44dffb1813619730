// ---------------------------------------------------------------------
//
// Copyright (C) 2026 by the Crevasse authors
//
// This file is part of Crevasse. It is free software; you can use it,
// redistribute it and/or modify it under the terms of the GNU Lesser
// General Public License as published by the Free Software Foundation;
// either version 2.1 of the License, or (at your option) any later version.
//
// ---------------------------------------------------------------------

#include <crevasse/discretisation/quadrature_field.h>

namespace Crevasse
{
  using namespace dealii;

  template <int dim>
  QuadratureField<dim>::QuadratureField(const Space<dim> &space)
    : offsets(space.mesh().n_active_cells(), numbers::invalid_unsigned_int)
    , n_local(0)
    , communicator(space.communicator())
  {
    for (const auto &cell : space.mesh().active_cell_iterators())
      if (cell->is_locally_owned())
        {
          offsets[cell->active_cell_index()] = n_local * n_components;
          n_local += space.quadrature(cell).size();
        }
    partitioner =
      std::make_shared<Utilities::MPI::Partitioner>(n_local * n_components,
                                                    0,
                                                    space.communicator());
  }



  template <int dim>
  void
  QuadratureField<dim>::initialize(Vector            &field,
                                   const unsigned int n_branches) const
  {
    if (n_branches == 1)
      field.reinit(partitioner);
    else
      field.reinit(std::make_shared<Utilities::MPI::Partitioner>(
        n_local * n_components * n_branches, 0, communicator));
  }



  template <int dim>
  std::size_t
  QuadratureField<dim>::offset(
    const typename Triangulation<dim>::active_cell_iterator &cell) const
  {
    Assert(cell->is_locally_owned(), ExcInternalError());
    return offsets[cell->active_cell_index()];
  }



  template <int dim>
  std::size_t
  QuadratureField<dim>::n_local_points() const
  {
    return n_local;
  }



  template <int dim>
  std::size_t
  QuadratureField<dim>::n_points() const
  {
    return partitioner->size() / n_components;
  }



  template class QuadratureField<2>;
  template class QuadratureField<3>;
} // namespace Crevasse
