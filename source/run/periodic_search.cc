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


#include <crevasse/periodic/anderson.h>
#include <crevasse/periodic/march.h>
#include <crevasse/run/periodic_search.h>

namespace Crevasse
{
  namespace
  {
    template <int dim>
    Ending
    march(const PeriodicStateParameters &parameters,
          ObservedPeriods<dim>          &periods,
          Vector                        &r)
    {
      return March<dim>(periods, parameters.tolerance).run(r);
    }



    template <int dim>
    Ending
    accelerate(const PeriodicStateParameters &parameters,
               const Body<dim>               &body,
               ObservedPeriods<dim>          &periods,
               Vector                        &r)
    {
      const EnergyCoordinates<dim>     coordinates(body.space,
                                               body.points,
                                               body.material.at(0.));
      typename Anderson<dim>::Settings settings;
      settings.acceleration = {parameters.anderson_depth,
                               parameters.anderson_damping};
      settings.delay        = parameters.anderson_delay;
      settings.tolerance    = parameters.tolerance;
      return Anderson<dim>(periods, coordinates, settings).run(r);
    }
  } // namespace



  template <int dim>
  PeriodicResult
  find_periodic_state(const Scene          &scene,
                      const Body<dim>      &body,
                      ObservedPeriods<dim> &periods)
  {
    const PeriodicStateParameters &parameters = scene.periodic_state;
    Vector                         viscous_strain;
    if (body.effects.viscosity.on)
      body.points.initialize(viscous_strain, body.law.branches().size());
    const Ending ending =
      parameters.method == "anderson" && body.effects.viscosity.on
        ? accelerate(parameters, body, periods, viscous_strain)
        : march(parameters, periods, viscous_strain);
    periods.finish(viscous_strain);
    PeriodicResult result = periods.result();
    result.converged      = ending == Ending::converged;
    return result;
  }



  template PeriodicResult
  find_periodic_state<2>(const Scene &, const Body<2> &, ObservedPeriods<2> &);
  template PeriodicResult
  find_periodic_state<3>(const Scene &, const Body<3> &, ObservedPeriods<3> &);
} // namespace Crevasse
