// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_time_integrator_choice_h
#define crevasse_time_integrator_choice_h

#include <crevasse/parameters/parameters.h>
#include <crevasse/time/integrator.h>

#include <memory>

namespace Crevasse
{
  /** The time integrators by their names in the scene.
   *
   * @param has_contact whether there are events to locate. */
  std::unique_ptr<Integrator>
  make_integrator(TimeIntegrationParameters parameters,
                  const double              period,
                  const bool                has_contact);

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
