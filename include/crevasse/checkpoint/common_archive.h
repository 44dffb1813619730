// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_checkpoint_common_archive_h
#define crevasse_checkpoint_common_archive_h

#include <crevasse/base/state_archive.h>

#include <deal.II/base/exceptions.h>
#include <deal.II/base/mpi.h>

#include <boost/archive/binary_iarchive.hpp>
#include <boost/archive/binary_oarchive.hpp>
#include <memory>
#include <sstream>

namespace Crevasse
{
  /** Archive of data that is the same on all ranks. It has no fields, as these
   * need a mesh first: see FieldArchive. */
  class CommonArchive : public StateArchive
  {
  public:
    /** Creates an empty archive for writing. */
    explicit CommonArchive(const MPI_Comm communicator)
      : mpi_communicator(communicator)
      , same_ranks(true)
      , stream(std::make_unique<std::stringstream>())
      , out(std::make_unique<boost::archive::binary_oarchive>(*stream))
    {
    }

    /** Opens an archive for reading.
     * @param bytes contents that the first rank wrote.
     * @param n_ranks number of ranks of the run that wrote the archive. */
    CommonArchive(const MPI_Comm     communicator,
                  const std::string &bytes,
                  const unsigned int n_ranks)
      : mpi_communicator(communicator)
      , same_ranks(dealii::Utilities::MPI::n_mpi_processes(communicator) ==
                   n_ranks)
      , stream(std::make_unique<std::stringstream>(bytes))
      , in(std::make_unique<boost::archive::binary_iarchive>(*stream))
    {
    }

    bool
    is_loading() const override
    {
      return in != nullptr;
    }
    bool
    has_same_ranks() const override
    {
      return same_ranks;
    }
    MPI_Comm
    communicator() const override
    {
      return mpi_communicator;
    }

    void
    nodal(Vector &) override
    {
      AssertThrow(false, dealii::ExcInternalError());
    }
    void
    at_points(Vector &) override
    {
      AssertThrow(false, dealii::ExcInternalError());
    }
    void
    on_bounds(std::vector<double> &) override
    {
      AssertThrow(false, dealii::ExcInternalError());
    }
    using StateArchive::on_bounds;
    void
    on_cells(dealii::Vector<double> &) override
    {
      AssertThrow(false, dealii::ExcInternalError());
    }

    /** Contents written so far. */
    std::string
    bytes() const
    {
      return stream->str();
    }

  protected:
    void
    exchange(std::vector<char> &item) override
    {
      if (is_loading())
        *in >> item;
      else
        *out << item;
    }

  private:
    MPI_Comm                                         mpi_communicator;
    bool                                             same_ranks;
    std::unique_ptr<std::stringstream>               stream;
    std::unique_ptr<boost::archive::binary_oarchive> out;
    std::unique_ptr<boost::archive::binary_iarchive> in;
  };
} // namespace Crevasse

#endif
