// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_time_event_functions_h
#define crevasse_time_event_functions_h

#include <crevasse/time/remembered_rate.h>

#include <deal.II/base/mpi.h>

namespace Crevasse
{
  /**
   * The functions of which ARKODE seeks the roots: φ of every contact node of
   * all ranks (RateEquation::switching_functions), each with a band of zero
   * around its roots. ARKODE brackets a root to rounding, which takes a dozen
   * contact problems; in the band it stops, and what the kink costs there is
   * of the order of its width squared.
   */
  class EventFunctions
  {
  public:
    /** @p equation must outlive this object. */
    explicit EventFunctions(RememberedRate &equation);

    /** Their number, after an evaluation of the equation with this @p r.
     * Collective. */
    unsigned int
    count(const Vector &r);

    /** The functions at t for this r. Collective. */
    void
    evaluate(const double t, const Vector &r, double *values);

  private:
    std::vector<double>
    gather(const MPI_Comm communicator) const;

    RememberedRate &equation;
    double          largest = 0.; ///< |φ| so far
    Vector          rate;
  };
} // namespace Crevasse

#endif
