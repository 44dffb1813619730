// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_periodic_stress_history_h
#define crevasse_periodic_stress_history_h

#include <crevasse/base/vector.h>

#include <map>

namespace Crevasse
{
  class StateArchive;

  /** The stress at all samples of one period, and how much each differs from
   * the sample that it replaces: that of the same instant. */
  class StressHistory
  {
  public:
    /** @param period Instants are the same if they differ by rounding of it. */
    explicit StressHistory(const double period);

    /** @param t The instant within the period. */
    void
    record(const double t, const Vector &stress);

    /** Ends a period. Largest change since the last call, relative to the
     * largest stress component (0 if all stress is zero), over all ranks, and
     * over those instants that the period before had too. What is new is
     * compared with an unstressed state in the first period only. */
    double
    take_change();

    /** Whether at least three quarters of the instants of the last period were
     * those of the period before: else its change says little. */
    bool
    is_comparable() const
    {
      return comparable;
    }

    /** Largest stress component of the last period for which take_change() was
     * called. */
    double
    largest_stress() const
    {
      return largest_of_last;
    }

    void
    serialize(StateArchive &archive);

  private:
    struct Entry
    {
      Vector       stress;
      unsigned int period;
    };

    const double            rounding;
    std::map<double, Entry> samples;
    unsigned int            periods    = 0; ///< that have ended
    std::size_t             n_new      = 0; ///< instants of this period
    bool                    comparable = true;

    MPI_Comm communicator    = MPI_COMM_SELF;
    double   largest_change  = 0.;
    double   largest         = 0.;
    double   largest_of_last = 0.;
  };
} // namespace Crevasse

#endif
