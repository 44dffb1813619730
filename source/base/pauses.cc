// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/pauses.h>

namespace Crevasse
{
  void
  Pauses::serialize_parts(StateArchive &archive) const
  {
    for (const auto &serialize : parts)
      serialize(archive);
  }



  StatePart::StatePart(Pauses                                    *pauses,
                       const std::function<void(StateArchive &)> &serialize)
    : pauses(pauses)
  {
    if (pauses != nullptr)
      pauses->parts.push_back(serialize);
  }



  StatePart::~StatePart()
  {
    // They go in the order opposite to that in which they came.
    if (pauses != nullptr)
      pauses->parts.pop_back();
  }
} // namespace Crevasse
