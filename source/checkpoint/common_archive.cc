// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/problems.h>
#include <crevasse/checkpoint/common_archive.h>

#include <deal.II/base/exceptions.h>
#include <deal.II/base/mpi.h>

#include <cstring>

namespace Crevasse
{
  using namespace dealii;

  CommonArchive::CommonArchive(const MPI_Comm communicator)
    : mpi_communicator(communicator)
    , loads(false)
    , same_ranks(true)
  {
  }



  CommonArchive::CommonArchive(const MPI_Comm      communicator,
                               std::vector<char> &&bytes,
                               const unsigned int  n_ranks)
    : mpi_communicator(communicator)
    , loads(true)
    , same_ranks(Utilities::MPI::n_mpi_processes(communicator) == n_ranks)
    , all(Utilities::MPI::broadcast(communicator, bytes, 0))
  {
  }



  bool
  CommonArchive::is_loading() const
  {
    return loads;
  }



  bool
  CommonArchive::has_same_ranks() const
  {
    return same_ranks;
  }



  MPI_Comm
  CommonArchive::communicator() const
  {
    return mpi_communicator;
  }



  void
  CommonArchive::exchange(std::vector<char> &item)
  {
    std::uint64_t size = item.size();
    if (!loads)
      {
        if (Utilities::MPI::this_mpi_process(mpi_communicator) != 0)
          return;
        const char *begin = reinterpret_cast<const char *>(&size);
        all.insert(all.end(), begin, begin + sizeof(size));
        all.insert(all.end(), item.begin(), item.end());
        return;
      }
    if (all.size() - position < sizeof(size))
      throw FileError(
        "The checkpoint ends where more is expected: it was "
        "written by another program.");
    std::memcpy(&size, all.data() + position, sizeof(size));
    position += sizeof(size);
    if (all.size() - position < size)
      throw FileError(
        "The checkpoint ends where more is expected: it was "
        "written by another program.");
    item.assign(all.begin() + position, all.begin() + position + size);
    position += size;
  }



  const std::vector<char> &
  CommonArchive::bytes() const
  {
    return all;
  }



  void
  CommonArchive::nodal(Vector &)
  {
    AssertThrow(false, ExcInternalError());
  }



  void
  CommonArchive::at_points(Vector &)
  {
    AssertThrow(false, ExcInternalError());
  }



  void
  CommonArchive::on_bounds(std::vector<double> &)
  {
    AssertThrow(false, ExcInternalError());
  }



  void
  CommonArchive::on_cells(dealii::Vector<double> &)
  {
    AssertThrow(false, ExcInternalError());
  }
} // namespace Crevasse
