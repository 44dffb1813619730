// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_time_period_observer_h
#define crevasse_time_period_observer_h

#include <crevasse/time/observer.h>

#include <algorithm>
#include <vector>

namespace Crevasse
{
  /** Keeps what it needs of the states of the last period, in the order of
   * their instants: of samples, before jumps, and between samples. */
  class PeriodObserver : public Observer
  {
  public:
    void
    observe(const Sample &sample) override
    {
      if (sample.step == 0)
        {
          instants.clear();
          clear();
        }
      add(sample, instants.size());
    }

    void
    before_jump(const Sample &sample) override
    {
      add(sample, instants.size());
    }

    void
    between(const Sample &sample) override
    {
      add(sample,
          std::lower_bound(instants.begin(), instants.end(), sample.instant) -
            instants.begin());
    }

    void
    serialize(StateArchive &archive) override
    {
      archive.common(instants);
    }

  protected:
    std::vector<double> instants; ///< of the last period, ascending

  private:
    /** Forgets a period. */
    virtual void
    clear() = 0;

    /** Inserts what is kept of a state before that of the k-th instant, or
     * appends it. Collective. */
    virtual void
    insert(const Sample &sample, const std::size_t k) = 0;

    void
    add(const Sample &sample, const std::size_t k)
    {
      insert(sample, k);
      instants.insert(instants.begin() + k, sample.instant);
    }
  };
} // namespace Crevasse

#endif
