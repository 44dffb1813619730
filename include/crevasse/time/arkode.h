// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_time_arkode_h
#define crevasse_time_arkode_h

#include <crevasse/parameters/parameters.h>
#include <crevasse/time/integrator.h>

namespace Crevasse
{
  /**
   * Creates a Runge–Kutta method of ARKODE (SUNDIALS), explicit or diagonally
   * implicit, of order 2 to 5. ARKODE takes the steps of the step list; or,
   * with the step control "adaptive", it chooses its own steps by an estimate
   * of the error, and the steps of the list are intervals between samples. To
   * locate events, ARKODE's root finding stops where a node of the lip
   * switches, and restarts there.
   *
   * Tolerances are for the stress that an error of r causes at constant strain:
   * fixed for each point, because r itself may drift.
   *
   * Implicit methods of order 3 and more begin with an explicit stage. If
   * nonlinear creep relaxes stress within the step, a step of the list is
   * divided if its error exceeds a tenth of the elastic stress.
   */
  std::unique_ptr<Integrator>
  make_arkode(const TimeIntegrationParameters &parameters);
} // namespace Crevasse

#endif
