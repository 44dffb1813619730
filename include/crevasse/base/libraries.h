// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_base_libraries_h
#define crevasse_base_libraries_h

#include <deal.II/base/config.h>

#include <SuiteSparse_config.h>
#include <map>
#include <string>

namespace Crevasse
{
  /** Names and versions of the numerical libraries. */
  inline std::map<std::string, std::string>
  library_versions()
  {
    const auto dotted = [](const int major, const int minor, const int patch) {
      return std::to_string(major) + '.' + std::to_string(minor) + '.' +
             std::to_string(patch);
    };
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
                    SUITESPARSE_SUBSUB_VERSION)}};
  }
} // namespace Crevasse

#endif
