// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_study_advise_pairs_h
#define crevasse_study_advise_pairs_h

#include <crevasse/study/advise_period.h>
#include <crevasse/study/advise_search.h>

#include <cstddef>
#include <functional>
#include <map>
#include <optional>
#include <vector>

namespace Crevasse
{
  /** Settings in space and in time together. */
  struct AdvisePair
  {
    std::size_t space = 0, time = 0; ///< points of the searches

    bool
    operator<(const AdvisePair &other) const;
    bool
    operator==(const AdvisePair &other) const;
  };

  /** What became of a pair that was run. */
  struct AdviseFinalist
  {
    AdvisePair       pair;
    const AdviseRun *run       = nullptr;
    const AdviseRun *reference = nullptr; ///< finer; null if none could be run
    double           error     = 0.;      ///< against this, or predicted
    double           shared    = 0.;      ///< part that both have, estimated
  };

  /**
   * Puts the settings in space and in time together: the squares of errors are
   * nearly added, and seconds nearly multiplied. The pair with the least
   * predicted seconds among those whose predicted errors are small enough is
   * run and compared with a finer one; what is learned from it corrects the
   * predictions, until none that was not run promises to be cheaper.
   */
  class AdvisePairs
  {
  public:
    using Run = std::function<const AdviseRun &(const AdviseCandidate &space,
                                                const AdviseCandidate &time,
                                                AdvisePeriod::Purpose)>;

    /** The errors, of the target, which the searches are to reach first. Steps
     * are searched on a coarse mesh, where finer ones cost little and leave
     * more choice. */
    static constexpr double part_in_space = 0.5, part_in_time = 0.25;

    /** @param base the point in time that all points in space were run with;
     * the index.
     * @param times_the_periods by how much more periods a pair has than a run
     * of the searches. */
    AdvisePairs(AdviseSearch     &space,
                AdviseSearch     &time,
                const std::size_t base,
                const double      target,
                const double      times_the_periods,
                const Run        &run,
                AdviseRuns       &runs);

    /** Whether the target is reached. Without a finalist none of the pairs
     * could be run. */
    bool
    find();

    /** All that were run, in this order. */
    const std::vector<AdviseFinalist> &
    finalists() const;

    /** The cheapest that reaches the target, or else the most accurate one. */
    const AdviseFinalist &
    best() const;

  private:
    double
    predicted_error(const AdvisePair &pair) const;

    /** As if it ran like a search. */
    double
    searched_seconds(const AdvisePair &pair) const;

    /** Of a pair, in space and in time. */
    AdvisePair
    families(const AdvisePair &pair) const;

    /** With what other pairs have taught. */
    double
    predicted_seconds(const AdvisePair &pair) const;

    /** Those that do not take too long; the cheapest one in any case. */
    std::vector<AdvisePair>
    affordable_pairs() const;

    std::vector<AdvisePair>
    most_accurate_first() const;

    bool
    was_run(const AdvisePair &pair) const;

    /** The pair to run next, if one promises to reach the target and may take
     * less than these seconds. */
    std::optional<AdvisePair>
    next(const double seconds) const;

    /** The cheapest of those that were run and reach the target. */
    const AdviseFinalist *
    cheapest_good() const;

    /** The cheapest pair that is finer in both parts, or the finest, and
     * accurate enough to measure against, else the most accurate of them;
     * nothing if there is none. */
    std::optional<AdvisePair>
    reference_for(const AdvisePair &pair) const;

    void
    try_pair(const AdvisePair &pair);

    void
    learn(const AdviseFinalist &finalist);

    AdviseSearch     &space, &time;
    const std::size_t base;
    const double      target, times_the_periods;
    const Run         run;
    AdviseRuns       &runs;

    std::vector<AdviseFinalist> all;
    std::vector<AdvisePair>     failed;
    /** Of the errors that the searches have found. */
    double factor_in_space = 1., factor_in_time = 1.;
    /** Of the seconds, for each family in space and in time. */
    std::map<AdvisePair, double> factor_of_seconds;
  };
} // namespace Crevasse

#endif
