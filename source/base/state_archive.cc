// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/problems.h>
#include <crevasse/base/state_archive.h>

#include <deal.II/base/mpi.h>

namespace Crevasse
{
  using namespace dealii;

  StateArchive::StateArchive(const MPI_Comm     communicator,
                             const std::string &bytes,
                             const unsigned int n_ranks)
    : mpi_communicator(communicator)
    , loads(true)
    , same_ranks(Utilities::MPI::n_mpi_processes(communicator) == n_ranks)
    , items(Utilities::unpack<std::vector<std::vector<char>>>(
        std::vector<char>(bytes.begin(), bytes.end()),
        false))
  {
  }



  std::string
  StateArchive::bytes() const
  {
    const std::vector<char> packed = Utilities::pack(items, false);
    return {packed.begin(), packed.end()};
  }



  void
  StateArchive::exchange(std::vector<char> &item)
  {
    if (loads)
      item = items.at(next++);
    else
      items.push_back(item);
  }



  void
  StateArchive::section(const std::string &name)
  {
    std::string found = name;
    common(found);
    if (found != name)
      throw FileError(
        "The checkpoint does not fit: it has \"" + found + "\" where \"" +
        name + "\" is expected. Another version of the program wrote it.");
  }



  void
  StateArchive::maximum(double &value)
  {
    double largest = Utilities::MPI::max(value, communicator());
    common(largest);
    if (is_loading())
      value = largest;
  }



  void
  StateArchive::on_bounds(std::vector<bool> &values)
  {
    std::vector<double> numbers(values.begin(), values.end());
    on_bounds(numbers);
    if (is_loading())
      values.assign(numbers.begin(), numbers.end());
  }
} // namespace Crevasse
