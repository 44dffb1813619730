// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_base_csv_table_h
#define crevasse_base_csv_table_h

#include <crevasse/base/problems.h>
#include <crevasse/base/text.h>

#include <deal.II/base/exceptions.h>

#include <fstream>
#include <string>
#include <vector>

namespace Crevasse
{
  /** A CSV file written row by row, so that finished rows survive a crash. A
   * number has the fewest digits that read back as the same number. */
  class CsvTable
  {
  public:
    /** @param file_name empty on ranks that do not write.
     * @param is_continuing Whether to append to the rows in the file.
     * @throw FileError if the file cannot be written. */
    CsvTable(const std::string              &file_name,
             const std::vector<std::string> &header,
             const bool                      is_continuing = false)
      : file_name(file_name)
      , n_columns(header.size())
    {
      if (file_name.empty())
        return;
      file.open(file_name, is_continuing ? std::ios::app : std::ios::trunc);
      if (!is_continuing)
        {
          for (std::size_t i = 0; i < n_columns; ++i)
            file << (i > 0 ? "," : "") << header[i];
          file << std::endl;
        }
      if (!file)
        throw FileError("Cannot write " + file_name + ".");
    }

    /** Writes a row. @throw FileError if it cannot be written. */
    void
    add_row(const std::vector<double> &values)
    {
      AssertDimension(values.size(), n_columns);
      if (file_name.empty())
        return;
      for (std::size_t i = 0; i < n_columns; ++i)
        file << (i > 0 ? "," : "") << Text::from_number(values[i]);
      file << std::endl;
      if (!file)
        throw FileError("Cannot write " + file_name +
                        ": is the disk full? The file has the earlier rows.");
    }

  private:
    const std::string file_name;
    const std::size_t n_columns;
    std::ofstream     file;
  };
} // namespace Crevasse

#endif
