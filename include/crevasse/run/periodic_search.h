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


#ifndef crevasse_run_periodic_search_h
#define crevasse_run_periodic_search_h

#include <crevasse/periodic/observed_periods.h>
#include <crevasse/run/body.h>
#include <crevasse/scene/scene.h>

namespace Crevasse
{
  /** Finds the periodic state by the method of the scene, from rest.
   *
   * @param periods of the scene's steps and scheme. */
  template <int dim>
  PeriodicResult
  find_periodic_state(const Scene          &scene,
                      const Body<dim>      &body,
                      ObservedPeriods<dim> &periods);
} // namespace Crevasse

#endif
