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

#ifndef crevasse_base_summary_h
#define crevasse_base_summary_h

#include <nlohmann/json.hpp>
#include <string>

namespace Crevasse
{
  /** summary.json, its keys in the order in which they were set. */
  using Summary = nlohmann::ordered_json;

  /** As a whole or not at all. @throw FileError */
  void
  write_summary(const Summary &summary, const std::string &file_name);
} // namespace Crevasse

#endif
