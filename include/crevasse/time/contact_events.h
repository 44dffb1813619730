// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_time_contact_events_h
#define crevasse_time_contact_events_h

#include <crevasse/time/integrator.h>

#include <memory>

namespace Crevasse
{
  /**
   * Divides the steps of another method where nodes of the lip open or close,
   * so that none of them crosses a kink of f: the method keeps its order
   * through contact (model, §2).
   *
   * A step after which nodes have switched is taken again up to the first of
   * the instants at which they did. That is found on the least switching
   * function, each value of which is the end of a trial step, by secants on
   * either side of the kink, and else by the regula falsi in the manner of
   * Anderson and Björck (BIT 13, 1973), to 10⁻⁷ of the step; what switches
   * closer together counts as one event. Errors of the instant count by their
   * square, for f is continuous.
   *
   * There is no Zeno behaviour: a step is divided at most 100 times, then it
   * goes on without, which is counted.
   */
  std::unique_ptr<Integrator>
  locate_contact_events(std::unique_ptr<Integrator> &&method);
} // namespace Crevasse

#endif
