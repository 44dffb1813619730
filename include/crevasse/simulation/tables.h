// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_simulation_tables_h
#define crevasse_simulation_tables_h

#include <crevasse/base/csv_table.h>
#include <crevasse/simulation/workspace.h>

namespace Crevasse
{
  /** The tables of a run, which rank 0 writes. */
  class Tables
  {
  public:
    template <int dim>
    explicit Tables(const Workspace<dim> &work)
      : is_continuing(work.state.has_tables())
      , directory(work.output.directory)
      , writes(dealii::Utilities::MPI::this_mpi_process(
                 work.setup.body.space.communicator()) == 0)
    {
    }

    /** Creates a table; without a file on ranks that do not write. */
    CsvTable
    table(const std::string &name, const std::vector<std::string> &columns)
    {
      names.push_back(name);
      return CsvTable(path(name), columns, is_continuing);
    }

    /** Path of a table; empty on ranks that do not write. */
    std::string
    path(const std::string &name) const
    {
      return writes ? directory + '/' + name : std::string();
    }

    std::vector<std::string> names;

  private:
    const bool        is_continuing; ///< whether tables have rows already
    const std::string directory;
    const bool        writes;
  };
} // namespace Crevasse

#endif
