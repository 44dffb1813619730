// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_checkpoint_field_archive_h
#define crevasse_checkpoint_field_archive_h

#include <crevasse/checkpoint/cellwise_fields.h>
#include <crevasse/checkpoint/common_archive.h>

#include <memory>

namespace Crevasse
{
  /** Where the numbers of fields go to, or come from: one after the other, each
   * cell by cell. */
  class FieldStore
  {
  public:
    virtual ~FieldStore() = default;

    /** @param n numbers that each cell of this rank, or each point, has. */
    virtual void
    of_cells(const unsigned int n, std::vector<double> &values) = 0;

    virtual void
    of_points(const unsigned int n, std::vector<double> &values) = 0;
  };

  /** A whole archive: what all ranks have alike goes on in a CommonArchive,
   * and fields are with a FieldStore. */
  template <int dim>
  class FieldArchive : public CommonArchive
  {
  public:
    /** @param common in which all before has been written, or read.
     * @param store must outlive this object. */
    FieldArchive(CommonArchive            &&common,
                 const CellwiseFields<dim> &fields,
                 FieldStore                &store);

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
    /** Whether there is anything, on any rank. */
    bool
    is_there(const std::size_t size);

    const CellwiseFields<dim> &fields;
    FieldStore                &store;
  };
} // namespace Crevasse

#endif
