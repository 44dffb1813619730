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
