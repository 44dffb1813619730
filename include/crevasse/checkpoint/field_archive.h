// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_checkpoint_field_archive_h
#define crevasse_checkpoint_field_archive_h

#include <crevasse/base/collectively.h>
#include <crevasse/base/problems.h>
#include <crevasse/base/state_archive.h>
#include <crevasse/model/body.h>

#include <filesystem>

namespace Crevasse
{
  /**
   * Complete archive of a run: what is the same on all ranks, and the fields.
   * The values of all fields are collected for each cell, one field after the
   * other, and saved as data attached to the cells of the mesh. So a run on
   * other ranks can read them, each rank the values of its cells.
   */
  template <int dim>
  class FieldArchive : public StateArchive
  {
  public:
    /** Continues an archive with fields. Collective.
     *
     * @param common archive so far; when reading, the mesh of @p body has been
     * loaded from the file of save_fields().
     * @param body must outlive the FieldArchive.
     * @param mesh the body's, to which data is attached; its cells stay.
     * @param expected bytes_of_cells() of an earlier archive, if any: reserved,
     * because growing vectors need up to twice the memory. */
    FieldArchive(StateArchive                  &&common,
                 const Body<dim>                &body,
                 Mesh<dim>                      &mesh,
                 const std::vector<std::size_t> &expected = {})
      : StateArchive(std::move(common))
      , body(body)
      , mesh(mesh)
      , of_cells(body.space.mesh().n_active_cells())
      , bounds(unilateral_bounds(body.lip, body.space))
    {
      if (!is_loading())
        {
          if (expected.size() == of_cells.size())
            for (std::size_t i = 0; i < expected.size(); ++i)
              of_cells[i].bytes.reserve(expected[i]);
          return;
        }
      const unsigned int handle = mesh.register_data_attach(
        [](const auto &, const auto) { return std::vector<char>(); }, true);
      mesh.notify_ready_to_unpack(
        handle, [this](const auto &cell, const auto, const auto &bytes) {
          of_cells[cell->active_cell_index()].bytes.assign(bytes.begin(),
                                                           bytes.end());
        });
    }

    /** Writes the mesh and all fields, and deletes the fields' values here: see
     * Triangulation::save(). Collective.
     * @throw FileError if a file is incomplete; deal.II's exceptions if one
     * cannot be written, after which the run cannot continue. */
    void
    save_fields(const std::string &file_name)
    {
      const std::size_t bytes = bytes_of_fields();
      mesh.register_data_attach(
        [this](const auto &cell, const auto) {
          return std::move(of_cells[cell->active_cell_index()].bytes);
        },
        true);
      mesh.save(file_name);
      // p4est's ranks write in turn: the file is complete after the barrier.
      const int error = MPI_Barrier(communicator());
      AssertThrowMPI(error);
      collectively(communicator(), [&]() {
        if (dealii::Utilities::MPI::this_mpi_process(communicator()) == 0)
          require_files(file_name, bytes);
      });
    }

    /** Upper bound of what save_fields() writes, over all ranks. Collective. */
    std::size_t
    bytes_to_save() const
    {
      constexpr std::size_t bytes_of_rank = 1 << 20, bytes_of_cell = 500;
      return bytes_of_fields() +
             bytes_of_rank *
               dealii::Utilities::MPI::n_mpi_processes(communicator()) +
             bytes_of_cell * body.space.mesh().n_global_active_cells();
    }

    /** Bytes of the fields of each cell, by active cell index, before
     * save_fields(). */
    std::vector<std::size_t>
    bytes_of_cells() const
    {
      std::vector<std::size_t> bytes;
      for (const CellData &cell : of_cells)
        bytes.push_back(cell.bytes.size());
      return bytes;
    }

    void
    nodal(Vector &field) override
    {
      if (!is_there(field.size()))
        return;
      Vector ghosted = body.space.ghosted_vector();
      if (is_loading())
        body.strain_operator.initialize(field);
      else
        {
          ghosted.copy_locally_owned_data_from(field);
          ghosted.update_ghost_values();
        }
      std::vector<dealii::types::global_dof_index> unknowns;
      std::vector<double>                          values;
      for (const Cell &cell : owned_cells(body.space.dof_handler))
        {
          body.space.get_unknowns(cell, unknowns);
          values.resize(unknowns.size());
          if (!is_loading())
            ghosted.extract_subvector_to(unknowns, values);
          exchange_of(cell, values.data(), values.size());
          if (is_loading())
            for (unsigned int i = 0; i < unknowns.size(); ++i)
              if (field.in_local_range(unknowns[i]))
                field(unknowns[i]) = values[i];
        }
      if (body.space.lip.n_unknowns > 0)
        on_lip(field);
    }
    void
    at_points(Vector &field) override
    {
      if (!is_there(field.size()))
        return;
      constexpr unsigned int n          = n_stress_components<dim>;
      unsigned int           n_branches = 0;
      if (!is_loading())
        n_branches = field.size() / (n * body.points.n_points());
      this->common(n_branches);
      if (is_loading())
        body.points.initialize(field, n_branches);
      for (const Cell &cell : owned_cells(body.space.dof_handler))
        exchange_of(cell,
                    field.begin() + n_branches * body.points.offset(cell),
                    n_branches * n * body.space.quadrature(cell).size());
    }
    void
    on_bounds(std::vector<double> &values) override
    {
      if (!is_there(values.size()))
        return;
      Vector field;
      body.strain_operator.initialize(field);
      for (std::size_t k = 0; k < values.size(); ++k)
        field(bounds.dofs[k]) = values[k];
      nodal(field);
      if (!is_loading())
        return;
      values.clear();
      for (const auto dof : bounds.dofs)
        values.push_back(field(dof));
    }
    using StateArchive::on_bounds;
    void
    on_cells(dealii::Vector<double> &values) override
    {
      if (is_loading())
        values.reinit(body.space.mesh().n_active_cells());
      for (const Cell &cell : owned_cells(body.space.dof_handler))
        exchange_of(cell, &values(cell->active_cell_index()), 1);
    }

  private:
    /** Checks the mesh files on rank 0. @throw FileError if incomplete. */
    static void
    require_files(const std::string &file_name, const std::size_t bytes)
    {
      for (const char *suffix : {"", ".info", "_fixed.data", "_variable.data"})
        {
          const std::string name = file_name + suffix;
          std::error_code   error;
          const std::size_t found = std::filesystem::file_size(name, error);
          if (error)
            throw FileError("Cannot read " + name + " (" + error.message() +
                            ").");
          if (found == 0 ||
              (name == file_name + "_variable.data" && found < bytes))
            throw FileError(name + " was not written as a whole.");
        }
    }

    using Cell = typename dealii::DoFHandler<dim>::active_cell_iterator;

    struct CellData
    {
      std::vector<char> bytes;
      std::size_t       next = 0; ///< next byte to read
    };

    /** Exchanges the unknowns of the lips, which belong to no cell and are the
     * same on any number of ranks. */
    void
    on_lip(Vector &field)
    {
      const auto          first = body.space.dof_handler.n_dofs();
      const auto          end   = body.space.singular_unknown(0);
      std::vector<double> values;
      for (auto i = first; i < end && !is_loading(); ++i)
        if (field.in_local_range(i))
          values.push_back(field(i));
      values = of_all_ranks(communicator(), values);
      this->common(values);
      for (auto i = first; i < end && is_loading(); ++i)
        if (field.in_local_range(i))
          field(i) = values[i - first];
    }

    /** Bytes of all fields, over all ranks. Collective. */
    std::size_t
    bytes_of_fields() const
    {
      std::size_t bytes = 0;
      for (const CellData &cell : of_cells)
        bytes += cell.bytes.size();
      return dealii::Utilities::MPI::sum(bytes, communicator());
    }

    /** Whether a field of this size is non-empty on any rank. Collective. */
    bool
    is_there(const std::size_t size)
    {
      int there = size > 0 ? 1 : 0;
      if (!is_loading())
        there = dealii::Utilities::MPI::max(there, communicator());
      this->common(there);
      return there == 1;
    }

    /** Appends @p n values to a cell's data, or reads the next @p n values. */
    void
    exchange_of(const Cell &cell, double *values, const std::size_t n)
    {
      CellData &data = of_cells[cell->active_cell_index()];
      if (is_loading())
        {
          const std::size_t bytes = n * sizeof(double);
          AssertThrow(data.next + bytes <= data.bytes.size(),
                      dealii::ExcInternalError());
          std::memcpy(values, data.bytes.data() + data.next, bytes);
          data.next += bytes;
        }
      else
        data.bytes.insert(data.bytes.end(),
                          reinterpret_cast<const char *>(values),
                          reinterpret_cast<const char *>(values + n));
    }

    const Body<dim>       &body;
    Mesh<dim>             &mesh;
    std::vector<CellData>  of_cells; ///< data of fields, by active cell index
    const UnilateralBounds bounds;
  };
} // namespace Crevasse

#endif
