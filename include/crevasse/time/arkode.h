// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_time_arkode_h
#define crevasse_time_arkode_h

#include <crevasse/parameters/parameters.h>
#include <crevasse/time/integrator.h>

namespace Crevasse
{
  /**
   * The Runge–Kutta methods of ARKODE (SUNDIALS), explicit or diagonally
   * implicit, of order 2 to 5. A step of the step list is one of ARKODE's; or,
   * with the step control "adaptive", ARKODE chooses its own from an estimate
   * of the error, and the steps of the list are intervals between samples,
   * which are interpolated. With events located, ARKODE's root finding
   * stops where a node of the lip switches, and begins anew there.
   *
   * Tolerances are on the stress that an error of r makes where the strain is
   * held: constant for each point, for r itself may drift.
   *
   * Implicit methods of order 3 and more begin with an explicit stage. Where
   * that creeps by a power of a stress that relaxes within the step, a step of
   * the list with an error of more than a tenth of the elastic stress is cut.
   */
  std::unique_ptr<Integrator>
  make_arkode(const TimeIntegrationParameters &parameters);
} // namespace Crevasse

#endif
