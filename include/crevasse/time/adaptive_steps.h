// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_time_adaptive_steps_h
#define crevasse_time_adaptive_steps_h

#include <crevasse/time/step_control.h>

namespace Crevasse
{
  /**
   * Steps whose error of the stress is within a tolerance: a part of what an
   * embedded method of order 1 estimates.
   *
   * The first period finds them by a proportional–integral controller
   * (Gustafsson, ACM Trans. Math. Softw. 17, 1991; Hairer and Wanner, Solving
   * ODEs II, IV.2). Later periods use them again, as the paper proposes
   * (§6.2.1), so that samples, matrices and factorisations repeat: a step
   * that has become too long is divided for good. Where the state of the
   * first period has taken many more steps than a later one needs they are
   * found anew, at most three times.
   *
   * Where steps have matrices of their own, their lengths are those of the
   * intervals between the fixed instants divided by powers of 2, so that
   * there are few.
   *
   * @param steps its fixed instants end steps in any case.
   * @param stability_limit see StepControl.
   */
  std::unique_ptr<StepControl>
  make_adaptive_steps(const TimeIntegrationParameters &parameters,
                      const double                     largest_step,
                      const StepList                  &steps,
                      const IntegratorProperties      &integrator,
                      const double                     stability_limit);
} // namespace Crevasse

#endif
