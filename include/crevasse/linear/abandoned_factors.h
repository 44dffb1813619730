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
