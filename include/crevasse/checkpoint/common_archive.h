// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_checkpoint_common_archive_h
#define crevasse_checkpoint_common_archive_h

#include <crevasse/base/state_archive.h>

namespace Crevasse
{
  /** The part of an archive that all ranks have alike, as a row of bytes; it
   * has no fields, for which there must be a mesh first. */
  class CommonArchive : public StateArchive
  {
  public:
    /** Empty, to be written. */
    explicit CommonArchive(const MPI_Comm communicator);

    /** To be read from the beginning on.
     * @param bytes what there is of it on the first rank.
     * @param n_ranks that it was written by. */
    CommonArchive(const MPI_Comm      communicator,
                  std::vector<char> &&bytes,
                  const unsigned int  n_ranks);

    bool
    is_loading() const override;

    bool
    has_same_ranks() const override;

    MPI_Comm
    communicator() const override;

    void
    nodal(Vector &field) override;

    void
    at_points(Vector &field) override;

    void
    on_bounds(std::vector<double> &values) override;
    using StateArchive::on_bounds;

    void
    on_cells(dealii::Vector<double> &values) override;

    /** What was written, on the first rank; others keep nothing of it. */
    const std::vector<char> &
    bytes() const;

  protected:
    void
    exchange(std::vector<char> &item) override;

  private:
    MPI_Comm          mpi_communicator;
    bool              loads, same_ranks;
    std::vector<char> all;
    std::size_t       position = 0;
  };
} // namespace Crevasse

#endif
