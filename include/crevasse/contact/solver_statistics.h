// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_contact_solver_statistics_h
#define crevasse_contact_solver_statistics_h

#include <crevasse/base/summary.h>
#include <crevasse/contact/certificate.h>

namespace Crevasse
{
  /** Numbers of the expensive operations of a run, and their errors. */
  struct SolverStatistics
  {
    std::size_t assemblies        = 0;
    std::size_t factorisations    = 0;
    std::size_t multigrid_setups  = 0;
    std::size_t linear_solves     = 0;
    std::size_t linear_iterations = 0;
    std::size_t vi_solves         = 0; ///< with bounds
    std::size_t vi_iterations     = 0;
    std::size_t implicit_stages   = 0; ///< of a power law

    std::size_t certified = 0; ///< solves with a certificate

    /** Solutions in which no contact force stops some free motion: stresses
     * and forces are certain, the position is one of many. */
    std::size_t undetermined = 0;

    /** The maxima over all solves. */
    Certificate certificate;

    /** The largest error that was accepted: the tolerance, or what rounding
     * leaves of it. */
    double accuracy = 0.;

    void
    add(const SolverStatistics &other);

    /** Counters and certificate of summary.json. */
    void
    add_to(Summary &summary) const;
  };
} // namespace Crevasse

#endif
