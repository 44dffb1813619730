// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_base_summary_h
#define crevasse_base_summary_h

#include <nlohmann/json.hpp>

namespace Crevasse
{
  /** Contents of summary.json, with keys in the order of insertion. */
  using Summary = nlohmann::ordered_json;
} // namespace Crevasse

#endif
