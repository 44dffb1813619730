// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_base_csv_table_h
#define crevasse_base_csv_table_h

#include <fstream>
#include <string>
#include <vector>

namespace Crevasse
{
  /** A table written row by row, so that what was computed survives whatever
   * happens next. A number has the fewest digits that read back as the same
   * one. */
  class CsvTable
  {
  public:
    /** @param file_name empty on ranks that do not write.
     * @param is_continuing Whether there are rows already, which stay.
     * @throw FileError if the file cannot be written. */
    CsvTable(const std::string              &file_name,
             const std::vector<std::string> &header,
             const bool                      is_continuing = false);

    /** @throw FileError if the row cannot be written. */
    void
    add_row(const std::vector<double> &values);

  private:
    const std::string file_name;
    const std::size_t n_columns;
    std::ofstream     file;
  };
} // namespace Crevasse

#endif
