// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_periodic_stress_history_h
#define crevasse_periodic_stress_history_h

#include <crevasse/base/vector.h>

#include <map>

namespace Crevasse
{
  class StateArchive;

  /** Stress at all samples of a period, and its changes from the samples at the
   * same instants of the period before. */
  class StressHistory
  {
  public:
    /** @param period of the loads; instants equal to rounding are the same. */
    explicit StressHistory(const double period);

    /** Records the stress at the instant @p t of the period. */
    void
    record(const double t, const Vector &stress);

    /** Stress at the instant @p t of the last period, which was recorded. */
    const Vector &
    at(const double t) const
    {
      return samples.lower_bound(t - rounding)->second.stress;
    }

    /** Ends a period and returns the largest change of stress since the last
     * call, relative to the largest stress component (0 if all stress is zero),
     * over all ranks and all instants that the period before had too. In the
     * first period stress is compared with an unstressed state. */
    double
    take_change();

    /** Whether at least three quarters of the last period's instants were those
     * of the period before; otherwise the change of stress says little. */
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

    /** Largest change of stress of the last period on this rank, and the index
     * of the local entry that changed so; invalid if that was before a resume.
     */
    struct Place
    {
      double       change = 0.;
      unsigned int entry  = dealii::numbers::invalid_unsigned_int;
    };

    const Place &
    place() const
    {
      return place_of_last;
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
    unsigned int            periods    = 0; ///< periods that have ended
    std::size_t             n_new      = 0; ///< new instants of this period
    bool                    comparable = true;

    MPI_Comm communicator = MPI_COMM_SELF;
    Place    largest_change, place_of_last;
    double   largest         = 0.;
    double   largest_of_last = 0.;
  };
} // namespace Crevasse

#endif
