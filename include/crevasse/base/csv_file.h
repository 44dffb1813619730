// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_base_csv_file_h
#define crevasse_base_csv_file_h

#include <string>
#include <vector>

namespace Crevasse
{
  /**
   * Reads a CSV file as loggers and spreadsheets write it: a line with the
   * names of the columns, and rows of numbers. Cells are separated by the
   * first comma, semicolon or tabulator of the names, or as a line "sep=;" says
   * before; they may be quoted, and empty cells may end a line. Lines that
   * begin with "#" are comments.
   */
  class CsvFile
  {
  public:
    /** @throw SceneError with file and row where a name or number is missing;
     * FileError if the file cannot be read. */
    explicit CsvFile(const std::string &file_name);

    std::vector<std::string>         names; ///< without units in brackets
    std::vector<std::vector<double>> columns;
    std::vector<std::string>         comments; ///< without "#"

    std::size_t
    n_rows() const
    {
      return columns.empty() ? 0 : columns[0].size();
    }

    /** @throw SceneError with the file, the line in it of row @p k of numbers,
     * if given, and the reason, unless fulfilled. */
    void
    demand(const bool         fulfilled,
           const std::string &reason,
           const std::size_t  k = -1) const;

  private:
    const std::string        file_name;
    std::vector<std::size_t> lines; ///< with the rows of numbers, from 1 on

    void
    read_numbers(const std::vector<std::string> &cells);
  };
} // namespace Crevasse

#endif
