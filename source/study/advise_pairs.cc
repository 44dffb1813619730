// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/problems.h>
#include <crevasse/study/advise_pairs.h>

#include <algorithm>
#include <cmath>
#include <tuple>

namespace Crevasse
{
  namespace
  {
    // What a reference has itself may be missing in a difference from it.
    constexpr double part_of_reference = 0.25;
    constexpr double part_accepted     = 0.9;

    constexpr std::size_t most_finalists = 12;

    // What one run of a pair, or of its reference, may be predicted to take.
    constexpr double most_seconds_of_pair = 1200.;

    // Predictions err: what a run of kinds that were run together before saves
    // must be more than noise, one of others may as well save what it seems to
    // cost in addition.
    constexpr double margin_if_known = 0.9, margin_if_new = 1.4;
  } // namespace



  bool
  AdvisePair::operator<(const AdvisePair &other) const
  {
    return std::tie(space, time) < std::tie(other.space, other.time);
  }



  bool
  AdvisePair::operator==(const AdvisePair &other) const
  {
    return space == other.space && time == other.time;
  }



  AdvisePairs::AdvisePairs(AdviseSearch     &space,
                           AdviseSearch     &time,
                           const std::size_t base,
                           const double      target,
                           const double      times_the_periods,
                           const Run        &run,
                           AdviseRuns       &runs)
    : space(space)
    , time(time)
    , base(base)
    , target(target)
    , times_the_periods(times_the_periods)
    , run(run)
    , runs(runs)
  {
  }



  const std::vector<AdviseFinalist> &
  AdvisePairs::finalists() const
  {
    return all;
  }



  bool
  AdvisePairs::find()
  {
    // A search that must become finer may do so a few times.
    constexpr unsigned int n_extensions = 3;
    double in_space = part_in_space * target, in_time = part_in_time * target;
    for (unsigned int extension = 0; extension <= n_extensions; ++extension)
      {
        while (all.size() + failed.size() < most_finalists)
          {
            const AdviseFinalist *good = cheapest_good();
            const auto            pair =
              next(good != nullptr ? good->run->seconds()
                                   : std::numeric_limits<double>::infinity());
            if (!pair)
              break;
            try_pair(*pair);
          }
        if (cheapest_good() != nullptr)
          return true;
        if (extension == n_extensions)
          break;
        in_space /= 2. * std::max(1., factor_in_space);
        in_time /= 2. * std::max(1., factor_in_time);
        const bool finer = space.extend_to(in_space);
        if (!time.extend_to(in_time) && !finer)
          break;
      }
    // Nothing promises it: the most accurate pair tells what can be had.
    if (all.empty())
      for (const AdvisePair &pair : most_accurate_first())
        if (all.empty() && failed.size() < most_finalists)
          try_pair(pair);
    if (all.empty())
      throw NumericalError(
        "advise: no combination of the settings that were "
        "tried in space and in time could be run; their "
        "folders below runs/ have log.txt.");
    return cheapest_good() != nullptr;
  }



  std::vector<AdvisePair>
  AdvisePairs::most_accurate_first() const
  {
    std::vector<AdvisePair> pairs = affordable_pairs();
    std::sort(pairs.begin(),
              pairs.end(),
              [&](const AdvisePair &a, const AdvisePair &b) {
                return predicted_error(a) < predicted_error(b);
              });
    return pairs;
  }



  const AdviseFinalist &
  AdvisePairs::best() const
  {
    if (const AdviseFinalist *good = cheapest_good())
      return *good;
    return *std::min_element(all.begin(),
                             all.end(),
                             [](const AdviseFinalist &a,
                                const AdviseFinalist &b) {
                               return a.error < b.error;
                             });
  }



  double
  AdvisePairs::predicted_error(const AdvisePair &pair) const
  {
    // Both are largest differences, of other probes or at other instants as a
    // rule: their sum is hardly ever reached.
    return std::hypot(factor_in_space * space.points()[pair.space].error,
                      factor_in_time * time.points()[pair.time].error);
  }



  double
  AdvisePairs::searched_seconds(const AdvisePair &pair) const
  {
    // Part of each run does not depend on its steps, nor on its periods.
    double least = std::numeric_limits<double>::infinity();
    for (const AdvisePoint &point : space.points())
      least = std::min(least, point.run->seconds());
    const double constant = 0.8 * least;
    return constant + (space.points()[pair.space].run->seconds() - constant) *
                        times_the_periods *
                        time.points()[pair.time].run->work() /
                        time.points()[base].run->work();
  }



  AdvisePair
  AdvisePairs::families(const AdvisePair &pair) const
  {
    return {space.points()[pair.space].family, time.points()[pair.time].family};
  }



  double
  AdvisePairs::predicted_seconds(const AdvisePair &pair) const
  {
    const auto learned = factor_of_seconds.find(families(pair));
    if (learned != factor_of_seconds.end())
      return learned->second * searched_seconds(pair);
    // Others were as far off, as far as is known.
    double sum = 0.;
    for (const auto &factor : factor_of_seconds)
      sum += std::log(factor.second);
    return searched_seconds(pair) *
           (factor_of_seconds.empty()
              ? 1.
              : std::exp(sum / factor_of_seconds.size()));
  }



  std::vector<AdvisePair>
  AdvisePairs::affordable_pairs() const
  {
    std::vector<AdvisePair> pairs;
    AdvisePair              cheapest{0, 0};
    for (std::size_t s = 0; s < space.points().size(); ++s)
      for (std::size_t t = 0; t < time.points().size(); ++t)
        {
          const AdvisePair pair{s, t};
          const double     seconds = predicted_seconds(pair);
          if (seconds <= most_seconds_of_pair)
            pairs.push_back(pair);
          if (seconds < predicted_seconds(cheapest))
            cheapest = pair;
        }
    // Even if nothing is, something must be run.
    if (pairs.empty())
      pairs.push_back(cheapest);
    return pairs;
  }



  bool
  AdvisePairs::was_run(const AdvisePair &pair) const
  {
    return std::find(failed.begin(), failed.end(), pair) != failed.end() ||
           std::any_of(all.begin(), all.end(), [&](const auto &finalist) {
             return finalist.pair == pair;
           });
  }



  std::optional<AdvisePair>
  AdvisePairs::next(const double seconds) const
  {
    std::optional<AdvisePair> best;
    double                    least = std::numeric_limits<double>::infinity();
    for (const AdvisePair &pair : affordable_pairs())
      if (!was_run(pair) && predicted_error(pair) <= part_accepted * target)
        {
          const bool   known     = factor_of_seconds.count(families(pair)) > 0;
          const double predicted = predicted_seconds(pair);
          if (predicted <
              std::min(least,
                       (known ? margin_if_known : margin_if_new) * seconds))
            {
              best  = pair;
              least = predicted;
            }
        }
    return best;
  }



  const AdviseFinalist *
  AdvisePairs::cheapest_good() const
  {
    const AdviseFinalist *best = nullptr;
    for (const AdviseFinalist &finalist : all)
      if (finalist.error <= part_accepted * target &&
          (best == nullptr || finalist.run->seconds() < best->run->seconds()))
        best = &finalist;
    return best;
  }



  std::optional<AdvisePair>
  AdvisePairs::reference_for(const AdvisePair &pair) const
  {
    // The finest of a search has nothing that is finer.
    const auto finer =
      [](const AdviseSearch &search, const std::size_t a, const std::size_t b) {
        return search.points()[a].error < search.points()[b].error ||
               (a == b && b == search.reference());
      };
    const double              enough = part_of_reference * target;
    std::optional<AdvisePair> best;
    for (const AdvisePair &other : affordable_pairs())
      if (!(other == pair) && finer(space, other.space, pair.space) &&
          finer(time, other.time, pair.time) &&
          std::find(failed.begin(), failed.end(), other) == failed.end())
        {
          // The cheapest of those that will do, or else the most accurate one.
          const auto rank = [&](const AdvisePair &one) {
            const double error = predicted_error(one);
            return error <= enough ? std::make_pair(0, predicted_seconds(one))
                                   : std::make_pair(1, error);
          };
          if (!best || rank(other) < rank(*best))
            best = other;
        }
    return best;
  }



  void
  AdvisePairs::try_pair(const AdvisePair &pair)
  {
    using Purpose     = AdvisePeriod::Purpose;
    const auto run_it = [&](const AdvisePair &one,
                            const Purpose     purpose) -> const AdviseRun & {
      return run(space.points()[one.space].candidate,
                 time.points()[one.time].candidate,
                 purpose);
    };
    AdviseFinalist finalist;
    finalist.pair = pair;
    finalist.run  = &run_it(pair, Purpose::result);
    if (!finalist.run->usable())
      {
        failed.push_back(pair);
        return;
      }
    constexpr unsigned int tries = 3;
    for (unsigned int k = 0; k < tries && finalist.reference == nullptr; ++k)
      {
        const auto reference = reference_for(pair);
        if (!reference)
          break;
        const AdviseRun *of = &run_it(*reference, Purpose::reference);
        if (!of->usable()) // its tolerance may be out of reach
          of = &run_it(*reference, Purpose::result);
        if (!of->usable())
          {
            failed.push_back(*reference);
            continue;
          }
        finalist.reference = of;
        // What both have in common, they do not differ in.
        if (reference->space == pair.space)
          finalist.shared += factor_in_space * space.points()[pair.space].error;
        if (reference->time == pair.time)
          finalist.shared += factor_in_time * time.points()[pair.time].error;
        finalist.error = runs.difference(*finalist.run, *of) + finalist.shared;
      }
    if (finalist.reference == nullptr)
      finalist.error = predicted_error(pair);
    all.push_back(finalist);
    learn(finalist);
  }



  void
  AdvisePairs::learn(const AdviseFinalist &finalist)
  {
    factor_of_seconds[families(finalist.pair)] =
      finalist.run->seconds() / searched_seconds(finalist.pair);

    const double predicted = predicted_error(finalist.pair);
    if (predicted == 0.)
      return;
    const double ratio = std::clamp(finalist.error / predicted, 0.2, 5.);
    const bool   space_dominates =
      factor_in_space * space.points()[finalist.pair.space].error >
      factor_in_time * time.points()[finalist.pair.time].error;
    // Which part was predicted too large is not known: the next run will tell.
    // If the error is larger than predicted, the larger part is to blame.
    if (ratio < 1. || space_dominates)
      factor_in_space *= ratio;
    if (ratio < 1. || !space_dominates)
      factor_in_time *= ratio;
  }
} // namespace Crevasse
