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

#include <crevasse/time/integrator.h>

namespace Crevasse
{
  void
  Integrator::restart()
  {
  }



  IntegratorStatistics
  Integrator::statistics() const
  {
    return {};
  }
} // namespace Crevasse
