// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_contact_solver_statistics_h
#define crevasse_contact_solver_statistics_h

#include <crevasse/base/summary.h>
#include <crevasse/contact/certificate.h>

namespace Crevasse
{
  /** Counts of the expensive operations of a run, and their largest errors. */
  struct SolverStatistics
  {
    std::size_t assemblies        = 0;
    std::size_t factorisations    = 0;
    std::size_t multigrid_setups  = 0;
    std::size_t linear_solves     = 0;
    std::size_t linear_iterations = 0;
    std::size_t vi_solves         = 0; ///< problems with bounds
    std::size_t vi_iterations     = 0;
    std::size_t implicit_stages   = 0; ///< stages of nonlinear creep
    std::size_t rate_evaluations  = 0;

    std::size_t certified = 0; ///< certified solves

    /** Number of solutions in which contact forces do not stop every free
     * motion: stresses and forces are unique, the position is not. */
    std::size_t undetermined = 0;

    /** Largest errors of all solves. */
    Certificate certificate;

    /** Largest accepted error: the tolerance, or more if rounding requires. */
    double accuracy = 0.;

    void
    add(const SolverStatistics &other);

    /** Adds "counters" to summary.json. */
    void
    add_counters(Summary &summary) const;

    /** Adds "certificate" to summary.json. */
    void
    add_certificate(Summary &summary) const;
  };
} // namespace Crevasse

#endif
