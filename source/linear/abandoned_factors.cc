// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

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
