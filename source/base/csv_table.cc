// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/csv_table.h>
#include <crevasse/base/problems.h>
#include <crevasse/base/text.h>

#include <deal.II/base/exceptions.h>

namespace Crevasse
{
  CsvTable::CsvTable(const std::string              &file_name,
                     const std::vector<std::string> &header,
                     const bool                      is_continuing)
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



  void
  CsvTable::add_row(const std::vector<double> &values)
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
} // namespace Crevasse
