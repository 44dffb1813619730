// ---------------------------------------------------------------------
//
// Copyright (C) 2026 by the Crevasse authors
//
// This file is part of Crevasse. It is free software; you can use it,
// redistribute it and/or modify it under the terms of the GNU Lesser
// General Public License as published by the Free Software Foundation;
// either version 2.1 of the License, or (at your option) any later version.
//
// ---------------------------------------------------------------------

#include <crevasse/run/machine_memory.h>

#include <deal.II/base/utilities.h>

#include <algorithm>
#include <fstream>
#include <limits>
#include <sstream>
#include <string>

namespace Crevasse
{
  using namespace dealii;

  namespace
  {
    /** What the machine can still give, as Linux says; infinite if it does not
     * say. */
    double
    free_memory()
    {
      double        bytes = std::numeric_limits<double>::infinity();
      std::ifstream meminfo("/proc/meminfo");
      for (std::string line; std::getline(meminfo, line);)
        {
          std::istringstream words(line);
          std::string        name;
          double             kibibytes;
          if (words >> name >> kibibytes && name == "MemAvailable:")
            bytes = 1024. * kibibytes;
        }
      // A container may have less than its machine.
      double        most, used;
      std::ifstream limit("/sys/fs/cgroup/memory.max");
      std::ifstream current("/sys/fs/cgroup/memory.current");
      if (limit >> most && current >> used)
        bytes = std::min(bytes, std::max(most - used, 0.));
      return bytes;
    }



    Utilities::System::MemoryStats
    memory_of_this_process()
    {
      Utilities::System::MemoryStats memory;
      Utilities::System::get_memory_stats(memory);
      return memory;
    }



    constexpr double kibibyte = 1024.;
  } // namespace



  double
  sum_on_machine(const double value, const MPI_Comm communicator)
  {
    MPI_Comm machine;
    MPI_Comm_split_type(
      communicator, MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &machine);
    const double sum = Utilities::MPI::sum(value, machine);
    MPI_Comm_free(&machine);
    return sum;
  }



  double
  available_memory(const MPI_Comm communicator)
  {
    return free_memory() +
           sum_on_machine(kibibyte * memory_of_this_process().VmRSS,
                          communicator);
  }



  std::vector<double>
  peak_memory_of_ranks(const MPI_Comm communicator)
  {
    return Utilities::MPI::gather(communicator,
                                  kibibyte * memory_of_this_process().VmHWM);
  }
} // namespace Crevasse
