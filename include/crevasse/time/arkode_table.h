// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_time_arkode_table_h
#define crevasse_time_arkode_table_h

#include <crevasse/time/integrator.h>

#include <arkode/arkode_butcher.h>
#include <memory>
#include <string>

namespace Crevasse
{
  /**
   * The Runge–Kutta pair that ARKODE is to use for an order.
   *
   * Explicit: Heun–Euler 2(1), Bogacki–Shampine 3(2), Zonneveld 4(3),
   * Dormand–Prince 5(4).
   *
   * Implicit, all L-stable and with one γ on the diagonal, so that equal steps
   * have equal matrices, and with the last stage at the end of the step: the
   * method of Sdirk2 with an embedded one of order 1, ESDIRK3(2)5L[2]SA, the
   * implicit part of ARK4(3)6L[2]SA (Kennedy and Carpenter, Appl. Numer. Math.
   * 44, 2003), and ESDIRK5(4)7L[2]SA2 (the same, 146, 2019). Not ARKODE's own
   * choices: its SDIRK-2-1-2 is not L-stable, and the estimates of the others
   * grow with stiffness.
   */
  class ArkodeTable
  {
  public:
    /** @param order from 2 to 5. */
    ArkodeTable(const bool is_implicit, const unsigned int order);

    const std::string &
    name() const
    {
      return table_name;
    }

    /** For ARKStepSetTables, which copies it. */
    ARKodeButcherTable
    table() const
    {
      return coefficients.get();
    }

    /** How many times larger than the error of the stress over periods the
     * estimate of a step is: it is that of the embedded method of lower order.
     */
    double
    excess_of_estimate() const
    {
      return excess;
    }

    /** Largest z for which |R(−x)| ≤ 1 for all x in [0,z], R the stability
     * function; infinite for implicit methods. */
    double
    stability_limit() const
    {
      return limit;
    }

    TimeQuadrature
    quadrature() const;

  private:
    using Pointer =
      std::unique_ptr<ARKodeButcherTableMem, void (*)(ARKodeButcherTable)>;

    std::string table_name;
    double      excess;
    double      limit;
    Pointer     coefficients;
  };
} // namespace Crevasse

#endif
