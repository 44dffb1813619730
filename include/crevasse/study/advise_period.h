// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_study_advise_period_h
#define crevasse_study_advise_period_h

#include <crevasse/base/log.h>
#include <crevasse/study/advise_candidates.h>
#include <crevasse/study/advise_runs.h>

#include <string>
#include <vector>

namespace Crevasse
{
  /**
   * How the periodic state is looked for: the method that finds it soonest on
   * a coarse mesh, and a tolerance whose error there is small beside the one
   * that is to be reached. A fixed number of periods from rest is left as it
   * is, but for searches, which take the first of them.
   */
  class AdvisePeriod
  {
  public:
    /** What a run is for. */
    enum class Purpose
    {
      search,   ///< for candidates, one part at a time
      result,   ///< as the advised scene is going to run
      reference ///< more accurate than that
    };

    AdvisePeriod(const Scene &scene, const double target);

    /** Settings of all but the part in time.
     * @throw NumericalError if no method finds the periodic state. */
    void
    choose(const std::vector<AdviseFamily> &in_time,
           const AdviseCandidate           &in_space,
           const std::vector<Override>     &common,
           AdviseRuns                      &runs,
           Log                             &log);

    std::vector<Override>
    settings(const AdviseCandidate &in_time, const Purpose purpose) const;

    /** By how much more periods a result has than a run of a search, if their
     * number is fixed. */
    double
    times_those_of_a_search() const;

    /** What they add to the name of a run; the same if they are the same. */
    std::string
    name(const AdviseCandidate &in_time, const Purpose purpose) const;

    /** For people. */
    std::string
    text(const AdviseCandidate &in_time) const;

  private:
    std::string
    method(const AdviseCandidate &in_time) const;

    std::vector<Override>
    settings_of(const std::string &method,
                const double       tolerance,
                const unsigned int maximum_periods) const;

    /** The method that takes the least time with these steps. */
    std::string
    cheapest_method(const AdviseCandidate       &in_time,
                    const AdviseCandidate       &in_space,
                    const std::vector<Override> &common,
                    AdviseRuns                  &runs) const;

    const bool         searched; ///< whether there is a tolerance
    const unsigned int own_periods, search_periods, maximum_periods;
    const double       target;
    double             tolerance;
    std::string        method_of_trapezoid, method_of_others;
  };

  /** One after the other. */
  std::vector<Override>
  joined(const std::vector<std::vector<Override>> &parts);
} // namespace Crevasse

#endif
