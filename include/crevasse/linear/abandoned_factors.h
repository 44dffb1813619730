// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_linear_abandoned_factors_h
#define crevasse_linear_abandoned_factors_h

#include <functional>

namespace Crevasse
{
  /** For a factor of several ranks that goes while an exception is on its way:
   * freeing it takes all ranks, which may be elsewhere. @p end frees it when
   * end_abandoned_factors() is called. */
  void
  abandon_factor(std::function<void()> end);

  /** Frees what exceptions left behind. To be called wherever one is caught
   * and the run goes on, where all ranks have caught it. Collective. */
  void
  end_abandoned_factors();
} // namespace Crevasse

#endif
