// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_time_adaptive_steps_h
#define crevasse_time_adaptive_steps_h

#include <crevasse/time/step_control.h>

namespace Crevasse
{
  /**
   * Makes a method take adaptive steps that keep the error of the stress, a
   * part of the estimate of an embedded method of order 1, within a tolerance.
   *
   * The first period finds the steps by a proportional–integral controller
   * (Gustafsson, ACM Trans. Math. Softw. 17, 1991; Hairer and Wanner, Solving
   * ODEs II, IV.2). Later periods reuse the steps, as the paper proposes
   * (§6.2.1), so that samples, matrices and factorisations repeat: a step that
   * has become too long is divided permanently. If the first period took many
   * more steps than a later one needs, steps are searched anew, at most three
   * times.
   *
   * If each step length has its own matrix, lengths are intervals between
   * fixed instants divided by powers of 2, so that few matrices occur.
   *
   * @param properties properties of the result.
   * @param steps changed by the result, which they must outlive; steps always
   * end at their fixed instants.
   * @param stability_limit see StepControl.
   */
  std::unique_ptr<Integrator>
  make_adaptive_steps(std::unique_ptr<Integrator>    &&method,
                      const IntegratorProperties      &properties,
                      const TimeIntegrationParameters &parameters,
                      const double                     largest_step,
                      StepList                        &steps,
                      const double                     stability_limit);
} // namespace Crevasse

#endif
