// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_periodic_run_state_h
#define crevasse_periodic_run_state_h

#include <crevasse/base/state_archive.h>
#include <crevasse/contact/solver_statistics.h>
#include <crevasse/periodic/observed_periods.h>

namespace Crevasse
{
  /** A part of a run on one mesh. */
  struct MeshStage
  {
    /** After which it ends if the run has not. */
    unsigned int last_period = std::numeric_limits<unsigned int>::max();
    /** Whether the run is over: periodic, or out of periods. */
    bool ends_run = false;
  };

  /**
   * What a run has come to at the end of a period: the state of the body, from
   * which it goes on wherever and on whatever mesh, and what its summary will
   * tell of the periods before. By itself it is a run that has not begun.
   */
  struct RunState
  {
    PeriodicResult result; ///< of the periods so far

    // On the mesh of the moment; empty at rest.
    Vector viscous_strain; ///< see QuadratureField
    Vector displacement;   ///< zero in constrained entries

    SolverStatistics solvers;
    double           largest_stress       = 0.;
    double           largest_displacement = 0.;
    double           largest_opening      = 0.;

    bool      fourier_failed = false; ///< on this mesh
    bool      was_resumed    = false; ///< this stage of the run
    MeshStage stage;

    dealii::Timer timer; ///< since the set-up of the meshes

    bool
    has_begun() const
    {
      return result.periods > 0;
    }

    /** Whether tables were begun, which go on. */
    bool
    has_tables() const
    {
      return has_begun() || was_resumed;
    }

    /** Shows what its stopwatches have measured, and all but the fields and
     * what belongs to the stage. */
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
      archive.common(fourier_failed);
    }
  };
} // namespace Crevasse

#endif
