// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/machine_memory.h>
#include <crevasse/base/problems.h>
#include <crevasse/base/text.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>

namespace Crevasse
{
  using namespace dealii;

  namespace
  {
    constexpr double infinite = std::numeric_limits<double>::infinity();
    constexpr double kibibyte = 1024.;



    /** Number after a name in a file, or at its beginning without a name;
     * @p otherwise if there is none, as in a file that says "max". */
    double
    number_in(const std::string &file_name,
              const std::string &name      = "",
              const double       otherwise = infinite)
    {
      std::ifstream file(file_name);
      std::string   word;
      while (word != name && file >> word)
        {
        }
      double number;
      return file >> number ? number : otherwise;
    }



    /** Memory in bytes that the limits of this process' control group and its
     * parents leave (version 2 of Linux's groups); infinite without a limit.
     * The cache of files counts as used memory, but Linux frees it on demand.
     * In a container the path may be one on the host, of which the container
     * sees the root only. */
    double
    left_by_groups()
    {
      std::ifstream file("/proc/self/cgroup");
      std::string   path;
      for (std::string line; std::getline(file, line);)
        if (line.rfind("0::/", 0) == 0)
          path = line.substr(3);
      double least = infinite;
      while (true)
        {
          const std::string folder = "/sys/fs/cgroup" + path;
          const double      limit  = number_in(folder + "/memory.max");
          const double      used   = number_in(folder + "/memory.current");
          if (limit < infinite && used < infinite)
            least = std::min(least,
                             std::max(limit - used +
                                        number_in(folder + "/memory.stat",
                                                  "inactive_file",
                                                  0.),
                                      0.));
          if (path.empty())
            return least;
          path.erase(path.rfind('/'));
        }
    }



    /** Sum of a value over the ranks on this machine. Collective. */
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
  } // namespace



  void
  require_memory(const double       bytes,
                 const double       of_libraries,
                 const double       n_unknowns,
                 const MPI_Comm     communicator,
                 const std::string &what,
                 const std::string &advice)
  {
    constexpr double uncertainty = 1.3; // of estimates: doc/scaling.md
    const double     needed      = sum_on_machine(bytes, communicator);
    // A container or a batch job may have less than its machine. Pages that
    // ranks share are not theirs.
    const double free =
      std::min(kibibyte * number_in("/proc/meminfo", "MemAvailable:"),
               left_by_groups());
    const double own   = number_in("/proc/self/status", "RssAnon:", 0.);
    const double there = free + sum_on_machine(kibibyte * own, communicator);
    if (Utilities::MPI::max(needed / there, communicator) <= uncertainty)
      return;
    // Memory of factors shrinks faster than the number of unknowns.
    const double fixed = sum_on_machine(of_libraries, communicator);
    const double fitting =
      n_unknowns *
      Utilities::MPI::min(std::max(0., (there - fixed) / (needed - fixed)),
                          communicator);
    throw SceneError(
      what +
      Text::format(
        " needs about %.3g GB of memory, but the machine has %.3g GB "
        "left. ",
        1e-9 * Utilities::MPI::max(needed, communicator),
        1e-9 * Utilities::MPI::min(there, communicator)) +
      advice +
      Text::format(" With these settings about %.2g unknowns fit; the mesh has "
                   "%.0f.",
                   std::floor(fitting),
                   n_unknowns));
  }



  std::vector<double>
  peak_memory_of_ranks(const MPI_Comm communicator)
  {
    return Utilities::MPI::gather(
      communicator, kibibyte * number_in("/proc/self/status", "VmHWM:", 0.));
  }
} // namespace Crevasse
