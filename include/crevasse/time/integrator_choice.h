// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_time_integrator_choice_h
#define crevasse_time_integrator_choice_h

#include <crevasse/parameters/scene.h>
#include <crevasse/time/integrator.h>
#include <crevasse/time/step_control.h>

#include <memory>

namespace Crevasse
{
  /** The time integrators by their names in the scene.
   *
   * @param has_contact whether there are events to locate. */
  std::unique_ptr<Integrator>
  make_integrator(TimeIntegrationParameters parameters,
                  const double              period,
                  const bool                has_contact);

  /** @param smallest_relaxation_time bounds adaptive steps, which are none
   * longer than those of Steps per period.
   * @throw NumericalError if the steps are beyond the limit of the integrator,
   * and that is to be checked. */
  std::unique_ptr<StepControl>
  make_step_control(const TimeIntegrationParameters &parameters,
                    const StepList                  &steps,
                    const Integrator                &integrator,
                    const double                     smallest_relaxation_time);
} // namespace Crevasse

#endif
