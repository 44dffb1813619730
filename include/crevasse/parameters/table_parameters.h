// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_parameters_table_parameters_h
#define crevasse_parameters_table_parameters_h

#include <crevasse/base/problems.h>
#include <crevasse/base/table_function.h>

#include <deal.II/base/parameter_handler.h>

namespace Crevasse
{
  /** Parameters of section Tables: CSV files whose columns are functions.
   * doc/tables.md describes the files. */
  struct TableParameters
  {
    static constexpr const char *section = "Tables";

    std::vector<std::string> files;
    /** The columns of the files, which all formulas share. */
    std::shared_ptr<TableFunctions> functions =
      std::make_shared<TableFunctions>();
    /** Instants at which steps must end: jumps and marked rows. */
    std::vector<double> step_ends;
    /** Warnings of formulas that call a table over t at other instants. */
    std::vector<std::string> warnings;

    void
    add_parameters(dealii::ParameterHandler &prm);

    /** Reads the files.
     * @throw SceneError with all of them that cannot be used, and why;
     * FileError if they only cannot be read. */
    void
    read(Problems &problems);

    /** Notes which functions the formulas of a scene call. */
    void
    find_calls(const dealii::ParameterHandler &prm);

    /** Checks that functions of time last a period and return to their first
     * value. */
    void
    check(const double period, Problems &problems) const;
  };
} // namespace Crevasse

#endif
