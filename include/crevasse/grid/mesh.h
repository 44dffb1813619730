// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_grid_mesh_h
#define crevasse_grid_mesh_h

#include <crevasse/base/vector.h>

#include <deal.II/distributed/tria.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/grid/filtered_iterator.h>

namespace Crevasse
{
  template <int dim>
  using Mesh = dealii::parallel::distributed::Triangulation<dim>;

  /** Active cells of this rank, of a mesh or a DoFHandler. */
  template <typename MeshOrDofs>
  auto
  owned_cells(const MeshOrDofs &all)
  {
    return all.active_cell_iterators() |
           dealii::IteratorFilters::LocallyOwnedCell();
  }

  /** Vector of zeros for the dofs, with ghosts for the cells that this rank
   * sees. */
  template <int dim>
  Vector
  make_vector(const dealii::DoFHandler<dim> &dofs)
  {
    return Vector(dofs.locally_owned_dofs(),
                  dealii::DoFTools::extract_locally_relevant_dofs(dofs),
                  dofs.get_communicator());
  }
} // namespace Crevasse

#endif
