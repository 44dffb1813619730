// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/time/step_control.h>

namespace Crevasse
{
  void
  StepControl::start(Integrator        &integrator,
                     RateEquation      &f,
                     const StepList    &steps,
                     const unsigned int k,
                     const Vector      &r,
                     Vector            &rate)
  {
    integrator.start(f, steps.instant(k), r, rate);
  }



  void
  StepControl::serialize(StateArchive &)
  {
  }



  void
  FixedSteps::begin_period(StepList &)
  {
  }



  void
  FixedSteps::advance(Integrator        &integrator,
                      RateEquation      &f,
                      StepList          &steps,
                      const unsigned int k,
                      const Vector      &rate,
                      Vector            &r)
  {
    integrator.advance(f, steps.instant(k), steps.step(k), rate, r);
  }
} // namespace Crevasse
