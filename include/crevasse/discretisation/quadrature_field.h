// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_discretisation_quadrature_field_h
#define crevasse_discretisation_quadrature_field_h

#include <crevasse/base/problems.h>
#include <crevasse/discretisation/space.h>
#include <crevasse/material/voigt.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/partitioner.h>

#include <limits>

namespace Crevasse
{
  /**
   * Layout of fields at quadrature points (viscous strain, stress): one
   * distributed vector, cell by cell in the order of the active cells of this
   * rank, with the n_stress_components of a point adjacent. Integrators, norms
   * and checkpoints see an ordinary vector.
   */
  template <int dim>
  class QuadratureField
  {
  public:
    static constexpr unsigned int n_components = n_stress_components<dim>;

    /** Makes the layout. Collective. @throw SceneError if deal.II's indices are
     * too short for the numbers of all points. */
    explicit QuadratureField(const Space<dim> &space)
      : offsets(space.mesh().n_active_cells(),
                dealii::numbers::invalid_unsigned_int)
      , communicator(space.communicator())
    {
      for (const auto &cell : owned_cells(space.mesh()))
        {
          offsets[cell->active_cell_index()] = n_local_points * n_components;
          n_local_points += space.quadrature(cell).size();
        }
      partitioner =
        make_partitioner(n_local_points * n_components, communicator);
    }

    /** Gives @p field this layout, all zero. Collective, and throws as the
     * constructor does.
     *
     * @param n_branches Number of branches at a point: the viscous strain of a
     * chain has the components of a branch adjacent, at the local index
     * n_branches × offset + branch × n_components. */
    void
    initialize(Vector &field, const unsigned int n_branches = 1) const
    {
      if (n_branches == 1)
        field.reinit(partitioner);
      else
        field.reinit(
          make_partitioner(n_local_points * n_components * n_branches,
                           communicator));
    }

    /** Local index of the first point of a locally owned cell. */
    std::size_t
    offset(const typename dealii::Triangulation<dim>::active_cell_iterator
             &cell) const
    {
      Assert(cell->is_locally_owned(), dealii::ExcInternalError());
      return offsets[cell->active_cell_index()];
    }

    /** Number of the first point of a cell among the points of this rank. */
    std::size_t
    first_point(const typename dealii::Triangulation<dim>::active_cell_iterator
                  &cell) const
    {
      return offset(cell) / n_components;
    }

    /** Numbers of points on this rank, and on all ranks. */
    std::size_t n_local_points = 0;
    std::size_t
    n_points() const
    {
      return partitioner->size() / n_components;
    }

    /** Components that begin at the local index @p offset. */
    static VoigtVector<dim>
    get(const Vector &field, const std::size_t offset)
    {
      VoigtVector<dim> value;
      for (unsigned int c = 0; c < n_components; ++c)
        value[c] = field.local_element(offset + c);
      return value;
    }

    static void
    set(Vector &field, const std::size_t offset, const VoigtVector<dim> &value)
    {
      for (unsigned int c = 0; c < n_components; ++c)
        field.local_element(offset + c) = value[c];
    }

  private:
    /** Partitioner for so many numbers of this rank. Collective.
     * @throw SceneError if deal.II's indices cannot count all numbers. */
    static std::shared_ptr<dealii::Utilities::MPI::Partitioner>
    make_partitioner(const std::uint64_t n_local, const MPI_Comm communicator)
    {
      constexpr std::uint64_t most =
        std::numeric_limits<dealii::types::global_dof_index>::max();
      const std::uint64_t n =
        dealii::Utilities::MPI::sum(n_local, communicator);
      if (n > most)
        throw SceneError(
          "[Geometry]: a field at the quadrature points has " +
          std::to_string(n) + " numbers, and this deal.II counts to " +
          std::to_string(most) +
          ". Configure deal.II with DEAL_II_WITH_64BIT_INDICES = ON, or make "
          "the mesh coarser.");
      return std::make_shared<dealii::Utilities::MPI::Partitioner>(
        n_local, 0, communicator);
    }

    std::vector<std::size_t> offsets; // offset by active cell index
    const MPI_Comm           communicator;
    std::shared_ptr<dealii::Utilities::MPI::Partitioner> partitioner;
  };
} // namespace Crevasse

#endif
