// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_time_integrator_choice_h
#define crevasse_time_integrator_choice_h

#include <crevasse/parameters/parameters.h>
#include <crevasse/time/integrator.h>

namespace Crevasse
{
  /** Creates a time integrator by its name in the scene.
   *
   * @param has_contact whether there are events to locate.
   * @param has_friction whether Scheme = automatic locates them; not for creep
   * that is nonlinear. */
  std::unique_ptr<Integrator>
  make_integrator(TimeIntegrationParameters parameters,
                  const bool                has_contact,
                  const bool                has_friction = false);
} // namespace Crevasse

#endif
