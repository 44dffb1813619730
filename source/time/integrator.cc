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
