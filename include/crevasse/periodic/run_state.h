// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_periodic_run_state_h
#define crevasse_periodic_run_state_h

#include <crevasse/base/state_archive.h>
#include <crevasse/contact/solver_statistics.h>
#include <crevasse/periodic/observed_periods.h>

namespace Crevasse
{
  /**
   * State of a run at the end of a period: the state of the body, from which
   * the run continues with any method on any mesh, and results of the periods
   * so far for the summary. By default, a run that has not begun.
   */
  struct RunState
  {
    PeriodicResult result; ///< results of the periods so far

    // Fields on the current mesh; empty at rest.
    Vector viscous_strain; ///< r at points, see QuadratureField
    Vector displacement;   ///< q; zero in constrained entries

    SolverStatistics solvers;
    double           largest_stress       = 0.;
    double           largest_displacement = 0.;
    double           largest_opening      = 0.;

    bool method_failed = false; ///< whether another method has taken over
    bool was_resumed   = false; ///< whether this mesh was resumed

    dealii::Timer timer; ///< runs since the set-up of the meshes

    bool
    has_begun() const
    {
      return result.periods > 0;
    }

    /** Whether the tables already exist, so that the run appends to them. */
    bool
    has_tables() const
    {
      return has_begun() || was_resumed;
    }

    /** Serialises results and readings of the stopwatches, without the fields
     * and the members of this mesh. */
    void
    serialize(StateArchive &archive)
    {
      archive.section("run");
      archive.common(result.periods);
      archive.common(result.converged);
      archive.common(result.steps_repeat);
      archive.common(result.stress_change);
      archive.common(result.stress_error_estimate);
      archive.common(solvers);
      archive.common(largest_stress);
      archive.common(largest_displacement);
      archive.common(largest_opening);
      Stopwatch::update();
      archive.common(meters);
      archive.common(method_failed);
    }
  };
} // namespace Crevasse

#endif
