// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/summary.h>
#include <crevasse/base/text_file.h>

namespace Crevasse
{
  void
  write_summary(const Summary &summary, const std::string &file_name)
  {
    write_atomically(summary.dump(2) + '\n', file_name);
  }
} // namespace Crevasse
