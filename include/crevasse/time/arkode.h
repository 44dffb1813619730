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
   * held: constant for each point, for r itself may drift. ARKODE looks at the
   * root mean square over all points, but the error is largest where the stress
   * is, at the tip: tolerances are divided by how much larger the largest rate
   * of stress of the elastic body is than its root mean square.
   */
  std::unique_ptr<Integrator>
  make_arkode(const TimeIntegrationParameters &parameters, const double period);
} // namespace Crevasse

#endif
