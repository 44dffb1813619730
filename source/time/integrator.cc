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



  void
  Integrator::start(RateEquation &f,
                    const double  t,
                    const Vector &r,
                    Vector       &rate)
  {
    f.rate(t, r, rate);
  }



  bool
  Integrator::has_error_estimate() const
  {
    return false;
  }



  bool
  Integrator::may_pause() const
  {
    return true;
  }



  void
  Integrator::serialize(StateArchive &)
  {
  }



  bool
  Integrator::has_matrix_of_step() const
  {
    return false;
  }



  IntegratorStatistics
  Integrator::statistics() const
  {
    return {};
  }
} // namespace Crevasse
