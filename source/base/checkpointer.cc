// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/checkpointer.h>

namespace Crevasse
{
  void
  Checkpointer::serialize_parts(StateArchive &archive) const
  {
    for (const auto &serialize : parts)
      serialize(archive);
  }



  SerializationScope::SerializationScope(
    Checkpointer                              *checkpointer,
    const std::function<void(StateArchive &)> &serialize)
    : checkpointer(checkpointer)
  {
    if (checkpointer != nullptr)
      checkpointer->parts.push_back(serialize);
  }



  SerializationScope::~SerializationScope()
  {
    // They go in the order opposite to that in which they came.
    if (checkpointer != nullptr)
      checkpointer->parts.pop_back();
  }
} // namespace Crevasse
