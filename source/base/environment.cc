// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/environment.h>
#include <crevasse/base/text.h>
#include <crevasse/base/version.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/multithread_info.h>
#include <deal.II/lac/lapack_templates.h>

#include <SuiteSparse_config.h>
#include <ctime>
#include <dlfcn.h>
#include <dmumps_c.h>
#include <filesystem>
#include <fstream>
#include <iomanip>
#include <sstream>

namespace Crevasse
{
  using namespace dealii;

  namespace
  {
    std::string
    dotted(const int major, const int minor, const int patch)
    {
      return std::to_string(major) + '.' + std::to_string(minor) + '.' +
             std::to_string(patch);
    }



    /** Name of the processor as Linux knows it; "unknown" elsewhere. */
    std::string
    processor()
    {
      std::ifstream file("/proc/cpuinfo");
      for (std::string line; std::getline(file, line);)
        if (line.rfind("model name", 0) == 0)
          return Utilities::trim(line.substr(line.find(':') + 1));
      return "unknown";
    }



    /** What the BLAS in use says of itself; if it is not OpenBLAS, its file,
     * which Debian's alternatives choose. */
    std::string
    blas()
    {
      using Configuration = char *();
      if (void *const configuration =
            dlsym(RTLD_DEFAULT, "openblas_get_config"))
        return reinterpret_cast<Configuration *>(configuration)();
      Dl_info place;
      if (dladdr(reinterpret_cast<void *>(&dgemm_), &place) == 0)
        return "unknown";
      std::error_code unknown;
      const auto file = std::filesystem::canonical(place.dli_fname, unknown);
      return unknown ? place.dli_fname : file.string();
    }



    constexpr const char *compiler = CREVASSE_COMPILER;
  } // namespace



  std::map<std::string, std::string>
  library_versions()
  {
    return {{"deal.II", DEAL_II_PACKAGE_VERSION},
            {"Trilinos",
             dotted(DEAL_II_TRILINOS_VERSION_MAJOR,
                    DEAL_II_TRILINOS_VERSION_MINOR,
                    DEAL_II_TRILINOS_VERSION_SUBMINOR)},
            {"p4est",
             dotted(DEAL_II_P4EST_VERSION_MAJOR,
                    DEAL_II_P4EST_VERSION_MINOR,
                    DEAL_II_P4EST_VERSION_SUBMINOR)},
            {"SuiteSparse",
             dotted(SUITESPARSE_MAIN_VERSION,
                    SUITESPARSE_SUB_VERSION,
                    SUITESPARSE_SUBSUB_VERSION)},
            {"MUMPS", MUMPS_VERSION},
            {"SUNDIALS",
             dotted(DEAL_II_SUNDIALS_VERSION_MAJOR,
                    DEAL_II_SUNDIALS_VERSION_MINOR,
                    DEAL_II_SUNDIALS_VERSION_PATCH)}};
  }



  Summary
  environment(const std::vector<std::string> &command_line)
  {
    std::ostringstream date;
    const std::time_t  now = std::time(nullptr);
    date << std::put_time(std::gmtime(&now), "%Y-%m-%dT%H:%M:%SZ");
    return {{"date", date.str()},
            {"processor", processor()},
            {"compiler", compiler},
            {"blas", blas()},
            {"processes", Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD)},
            {"threads", MultithreadInfo::n_threads()},
            {"command_line", command_line}};
  }



  std::string
  version_text()
  {
    std::vector<std::string> libraries;
    for (const auto &[name, version] : library_versions())
      libraries.push_back(name + ' ' + version);
    return std::string("crevasse " CREVASSE_VERSION "\nrevision ") +
           CREVASSE_GIT_REVISION + ", " + compiler + '\n' +
           Text::join(libraries, ", ") + "\nBLAS: " + blas() +
           "\nprocessor: " + processor();
  }
} // namespace Crevasse
