// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_checkpoint_field_archive_h
#define crevasse_checkpoint_field_archive_h

#include <crevasse/checkpoint/common_archive.h>
#include <crevasse/model/body.h>


namespace Crevasse
{
  /**
   * A whole archive: what all ranks have alike goes on in a CommonArchive. The
   * numbers of all fields are collected for each cell, one field after the
   * other, and saved as data attached to the cells of the mesh. So other ranks
   * can read them, each those of its cells.
   */
  template <int dim>
  class FieldArchive : public CommonArchive
  {
  public:
    /** Collective.
     *
     * @param common in which all before has been written, or read: then the
     * mesh of the body has been loaded from the file of save_fields().
     * @param body must outlive this object.
     * @param expected bytes_of_cells() of an earlier one, if any: growing
     * vectors need up to twice the memory. */
    FieldArchive(CommonArchive                 &&common,
                 const Body<dim>                &body,
                 const std::vector<std::size_t> &expected = {});

    /** Writes the mesh and all fields, after which they are gone: see
     * Triangulation::save(). Collective.
     * @throw FileError if files are not whole; deal.II's exceptions if one
     * cannot be written, after which the run cannot go on. */
    void
    save_fields(const std::string &file_name);

    /** Not less than save_fields() writes, of all ranks. Collective. */
    std::size_t
    bytes_to_save() const;

    /** Of the fields of each cell, by active cell index; before they are
     * saved. */
    std::vector<std::size_t>
    bytes_of_cells() const;

    void
    nodal(Vector &field) override;
    void
    at_points(Vector &field) override;
    void
    on_bounds(std::vector<double> &values) override;
    using StateArchive::on_bounds;
    void
    on_cells(dealii::Vector<double> &values) override;

  private:
    using Cell = typename dealii::DoFHandler<dim>::active_cell_iterator;

    struct CellData
    {
      std::vector<char> bytes;
      std::size_t       next = 0; ///< to be read
    };

    /** Of all ranks. Collective. */
    std::size_t
    bytes_of_fields() const;

    /** Whether there is anything, on any rank. */
    bool
    is_there(const std::size_t size);

    /** Calls a function for each cell of this rank. */
    template <typename Function>
    void
    for_each_cell(const Function &f) const;

    /** Adds the numbers to those of a cell, or takes the next ones. */
    void
    exchange_of(const Cell &cell, double *values, const std::size_t n);

    const Body<dim>       &body;
    std::vector<CellData>  of_cells; ///< by active cell index
    const UnilateralBounds bounds;
  };
} // namespace Crevasse

#endif
