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

#ifndef crevasse_run_integrator_choice_h
#define crevasse_run_integrator_choice_h

#include <crevasse/run/body.h>
#include <crevasse/scene/parameters.h>
#include <crevasse/time/integrator.h>
#include <crevasse/time/step_list.h>

#include <memory>
#include <vector>

namespace Crevasse
{
  /** The time integrator by its name in the scene. */
  std::unique_ptr<Integrator>
  make_integrator(const TimeIntegrationParameters &parameters,
                  const double                     period);

  /** Whether its steps follow tolerances, which are relative to the scale of
   * the stress: see Evolution::set_stress_scale(). */
  bool
  has_tolerances(const TimeIntegrationParameters &parameters);

  /** The instants that tell this scale: some samples of the period, and the one
   * with the largest load. */
  template <int dim>
  std::vector<double>
  instants_of_stress_scale(const Body<dim> &body, const StepList &steps);
} // namespace Crevasse

#endif
