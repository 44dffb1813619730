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



  IntegratorStatistics
  FixedSteps::statistics() const
  {
    return {};
  }
} // namespace Crevasse
