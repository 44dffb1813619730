// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/time/integrator.h>

namespace Crevasse
{
  void
  Integrator::restart()
  {
  }



  void
  Integrator::start(RateEquation &f,
                    const double  t,
                    const Vector &r,
                    Vector       &rate)
  {
    f.rate(t, r, rate);
  }



  void
  Integrator::serialize(StateArchive &)
  {
  }
} // namespace Crevasse
