// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_base_csv_columns_h
#define crevasse_base_csv_columns_h

#include <map>
#include <string>
#include <vector>

namespace Crevasse
{
  /**
   * Reads the columns of a CSV file by the names in its first line. Lines that
   * begin with # are comments. Only cells of columns outside @p required may be
   * empty; they are nan.
   *
   * @throw SceneError naming the file and its line if a required column, a
   * cell or a number is missing; FileError if the file cannot be read.
   */
  std::map<std::string, std::vector<double>>
  read_csv_columns(const std::string              &file_name,
                   const std::vector<std::string> &required);
} // namespace Crevasse

#endif
