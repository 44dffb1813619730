// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_time_contact_events_h
#define crevasse_time_contact_events_h

#include <crevasse/time/integrator.h>

#include <memory>

namespace Crevasse
{
  /**
   * Divides the steps of a method where nodes of the lip open or close, so that
   * no step crosses a kink of f: the method keeps its order through contact
   * (model, §2).
   *
   * A step after which nodes have switched is repeated up to the first
   * switching. Its instant is the root of the least switching function,
   * evaluated by trial steps: by secants on either side of the kink, or else by
   * the regula falsi of Anderson and Björck (BIT 13, 1973), to 10⁻⁷ of the
   * step; closer switchings count as one event. Errors of the instant matter by
   * their square, as f is continuous.
   *
   * Zeno behaviour is excluded: after 100 divisions the rest of a step is not
   * divided, which is counted.
   */
  std::unique_ptr<Integrator>
  locate_contact_events(std::unique_ptr<Integrator> &&method);
} // namespace Crevasse

#endif
