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
  /** The part of an archive that all ranks have alike. It has no fields, for
   * which there must be a mesh first: see FieldArchive. */
  class CommonArchive : public StateArchive
  {
  public:
    /** Empty, to be written. */
    explicit CommonArchive(const MPI_Comm communicator)
      : mpi_communicator(communicator)
      , same_ranks(true)
      , stream(std::make_unique<std::stringstream>())
      , out(std::make_unique<boost::archive::binary_oarchive>(*stream))
    {
    }

    /** To be read from the beginning on.
     * @param bytes what the first rank has written.
     * @param n_ranks that it was written by. */
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

    /** What was written. */
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
