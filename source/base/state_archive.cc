// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/problems.h>
#include <crevasse/base/state_archive.h>

#include <deal.II/base/mpi.h>

#include <numeric>

namespace Crevasse
{
  using namespace dealii;

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
  StateArchive::part_of_sum(double &value)
  {
    std::vector<double> parts =
      Utilities::MPI::all_gather(communicator(), value);
    common(parts);
    if (!is_loading())
      return;
    const unsigned int rank = Utilities::MPI::this_mpi_process(communicator());
    if (has_same_ranks())
      value = parts[rank];
    else
      value = rank == 0 ? std::accumulate(parts.begin(), parts.end(), 0.) : 0.;
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
