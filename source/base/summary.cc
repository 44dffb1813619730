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
