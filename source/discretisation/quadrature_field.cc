// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/problems.h>
#include <crevasse/discretisation/quadrature_field.h>

#include <deal.II/base/mpi.h>

#include <cstdint>
#include <limits>

namespace Crevasse
{
  using namespace dealii;

  namespace
  {
    /** For so many numbers of this rank. Collective.
     * @throw SceneError if deal.II's indices cannot count those of all. */
    std::shared_ptr<Utilities::MPI::Partitioner>
    make_partitioner(const std::uint64_t n_local, const MPI_Comm communicator)
    {
      constexpr std::uint64_t most =
        std::numeric_limits<types::global_dof_index>::max();
      const std::uint64_t n = Utilities::MPI::sum(n_local, communicator);
      if (n > most)
        throw SceneError(
          "[Geometry]: a field at the quadrature points has " +
          std::to_string(n) + " numbers, and this deal.II counts to " +
          std::to_string(most) +
          ". Configure deal.II with DEAL_II_WITH_64BIT_INDICES = ON, or make "
          "the mesh coarser.");
      return std::make_shared<Utilities::MPI::Partitioner>(n_local,
                                                           0,
                                                           communicator);
    }
  } // namespace



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
    partitioner = make_partitioner(n_local * n_components, communicator);
  }



  template <int dim>
  void
  QuadratureField<dim>::initialize(Vector            &field,
                                   const unsigned int n_branches) const
  {
    if (n_branches == 1)
      field.reinit(partitioner);
    else
      field.reinit(
        make_partitioner(n_local * n_components * n_branches, communicator));
  }



  template class QuadratureField<2>;
  template class QuadratureField<3>;
} // namespace Crevasse
