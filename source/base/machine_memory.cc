// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/format.h>
#include <crevasse/base/machine_memory.h>
#include <crevasse/base/text.h>

#include <algorithm>
#include <fstream>
#include <limits>
#include <sstream>

namespace Crevasse
{
  using namespace dealii;

  namespace
  {
    constexpr double infinite = std::numeric_limits<double>::infinity();
    constexpr double kibibyte = 1024.;



    /** Number after a name in a file with lines "name number ..."; @p otherwise
     * if there is none. */
    double
    number_in(const std::string &file_name,
              const std::string &name,
              const double       otherwise)
    {
      std::ifstream file(file_name);
      for (std::string line; std::getline(file, line);)
        {
          std::istringstream words(line);
          std::string        word;
          double             number;
          if (words >> word >> number && word == name)
            return number;
        }
      return otherwise;
    }



    /** Number in a file that contains nothing else; infinite if the file says
     * "max" or does not exist. */
    double
    number_in(const std::string &file_name)
    {
      std::ifstream file(file_name);
      double        number;
      return file >> number ? number : infinite;
    }



    /** Names of files of a version of Linux's control groups. */
    struct GroupFiles
    {
      const char *folder, *limit, *used, *cache;
    };

    constexpr GroupFiles version_1 = {"/sys/fs/cgroup/memory",
                                      "/memory.limit_in_bytes",
                                      "/memory.usage_in_bytes",
                                      "total_inactive_file"};
    constexpr GroupFiles version_2 = {"/sys/fs/cgroup",
                                      "/memory.max",
                                      "/memory.current",
                                      "inactive_file"};



    /** Memory that the limits of a control group and its parents leave, in
     * bytes. The cache of files counts as used memory, but Linux frees it on
     * demand.
     *
     * @param path Group, "" for the root. In a container, it may be a path on
     * the host, of which the container sees the root only. */
    double
    left_by_groups(const GroupFiles &files, std::string path)
    {
      double least = infinite;
      while (true)
        {
          const std::string folder = files.folder + path;
          const double      limit  = number_in(folder + files.limit);
          const double      used   = number_in(folder + files.used);
          if (limit < infinite && used < infinite)
            least = std::min(
              least,
              std::max(limit - used +
                         number_in(folder + "/memory.stat", files.cache, 0.),
                       0.));
          if (path.empty())
            return least;
          path.erase(path.rfind('/'));
        }
    }



    /** Memory that the control groups of this process leave, in bytes, from
     * lines "number:controllers:path". */
    double
    left_by_groups()
    {
      double        least = infinite;
      std::ifstream groups("/proc/self/cgroup");
      for (std::string line; std::getline(groups, line);)
        {
          const auto parts = Text::split(line, ':');
          if (parts.size() != 3)
            continue;
          const std::string path =
            parts[2].size() > 1 && parts[2][0] == '/' ? parts[2] : "";
          if (parts[1].empty())
            least = std::min(least, left_by_groups(version_2, path));
          else if (("," + parts[1] + ",").find(",memory,") != std::string::npos)
            least = std::min(least, left_by_groups(version_1, path));
        }
      return least;
    }



    /** Free memory in bytes, as Linux reports it; infinite if unknown. A
     * container or a batch job may have less than its machine. */
    double
    free_memory()
    {
      return std::min(kibibyte *
                        number_in("/proc/meminfo", "MemAvailable:", infinite),
                      left_by_groups());
    }



    /** Memory in bytes of this process without pages that ranks share. */
    double
    own_memory()
    {
      return kibibyte * number_in("/proc/self/status", "RssAnon:", 0.);
    }
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
    return free_memory() + sum_on_machine(own_memory(), communicator);
  }



  std::vector<double>
  peak_memory_of_ranks(const MPI_Comm communicator)
  {
    return Utilities::MPI::gather(
      communicator, kibibyte * number_in("/proc/self/status", "VmHWM:", 0.));
  }



  std::string
  gigabytes(const double bytes)
  {
    return Text::format("%.3g GB", 1e-9 * bytes);
  }
} // namespace Crevasse
