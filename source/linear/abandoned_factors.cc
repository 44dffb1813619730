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


#include <crevasse/linear/abandoned_factors.h>

#include <utility>
#include <vector>

namespace Crevasse
{
  namespace
  {
    /** In the order in which they went, which is the same on all ranks. */
    std::vector<std::function<void()>> &
    abandoned()
    {
      static std::vector<std::function<void()>> ends;
      return ends;
    }
  } // namespace



  void
  abandon_factor(std::function<void()> end)
  {
    abandoned().push_back(std::move(end));
  }



  void
  end_abandoned_factors()
  {
    for (const std::function<void()> &end : std::exchange(abandoned(), {}))
      end();
  }
} // namespace Crevasse
