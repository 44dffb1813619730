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

#include <crevasse/output/csv_table.h>
#include <crevasse/scene/problems.h>

#include <deal.II/base/exceptions.h>

#include <filesystem>
#include <limits>
#include <system_error>

namespace Crevasse
{
  CsvTable::CsvTable(const std::string              &file_name,
                     const std::vector<std::string> &header)
    : file_name(file_name)
    , n_columns(header.size())
    , file(file_name)
  {
    file.precision(std::numeric_limits<double>::max_digits10);
    for (std::size_t i = 0; i < n_columns; ++i)
      file << (i > 0 ? "," : "") << header[i];
    file << std::endl;
    if (!file)
      throw FileError("Cannot write " + file_name + ".");
  }



  void
  CsvTable::add_row(const std::vector<double> &values)
  {
    AssertDimension(values.size(), n_columns);
    for (std::size_t i = 0; i < n_columns; ++i)
      file << (i > 0 ? "," : "") << values[i];
    file << std::endl;
    if (!file)
      throw FileError("Cannot write " + file_name +
                      ": is the disk full? The rows before are there.");
  }



  void
  require_writable_directory(const std::string &directory)
  {
    namespace fs = std::filesystem;
    std::error_code error;
    fs::create_directories(directory, error);
    if (error)
      throw FileError("[Output directory] " + directory +
                      ": cannot be created (" + error.message() +
                      "). Choose another one by --output DIR.");

    const fs::path probe    = fs::path(directory) / ".write_test";
    const bool     writable = std::ofstream(probe).put('\n').good();
    fs::remove(probe, error);
    if (!writable)
      throw FileError("[Output directory] " + directory +
                      ": cannot be written to. Choose another one by --output "
                      "DIR.");
  }
} // namespace Crevasse
