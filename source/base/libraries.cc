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

#include <crevasse/base/libraries.h>

#include <deal.II/base/config.h>

#include <SuiteSparse_config.h>

namespace Crevasse
{
  namespace
  {
    std::string
    dotted(const int major, const int minor, const int subminor)
    {
      return std::to_string(major) + '.' + std::to_string(minor) + '.' +
             std::to_string(subminor);
    }
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
                    SUITESPARSE_SUBSUB_VERSION)}};
  }
} // namespace Crevasse
