// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_base_summary_h
#define crevasse_base_summary_h

#include <crevasse/base/text_file.h>

#include <nlohmann/json.hpp>

namespace Crevasse
{
  /** Contents of summary.json, with keys in the order of insertion. */
  using Summary = nlohmann::ordered_json;

  /** Writes summary.json as a whole or not at all. @throw FileError */
  inline void
  write_summary(const Summary &summary, const std::string &file_name)
  {
    write_atomically(summary.dump(2) + '\n', file_name);
  }
} // namespace Crevasse

#endif
