// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/problems.h>
#include <crevasse/base/text.h>
#include <crevasse/study/advise_period.h>

#include <algorithm>

namespace Crevasse
{
  namespace
  {
    constexpr unsigned int periods_of_a_search = 3;
    // A march that takes more has found a faster method by then.
    constexpr unsigned int periods_of_a_march   = 30;
    constexpr unsigned int periods_at_least     = 200;
    constexpr double       tighter_in_reference = 10.; ///< this many times
    constexpr double       part_of_tolerance    = 0.1; ///< of the target
    constexpr double       clearly              = 0.7;
  } // namespace



  std::vector<Override>
  joined(const std::vector<std::vector<Override>> &parts)
  {
    std::vector<Override> all;
    for (const auto &part : parts)
      all.insert(all.end(), part.begin(), part.end());
    return all;
  }



  AdvisePeriod::AdvisePeriod(const Scene &scene, const double target)
    : searched(scene.periodic_state.tolerance > 0.)
    , own_periods(scene.periodic_state.maximum_periods)
    , search_periods(std::min(own_periods, periods_of_a_search))
    , maximum_periods(std::max(own_periods, periods_at_least))
    , target(target)
    , tolerance(target / 4.)
  {
  }



  void
  AdvisePeriod::choose(const std::vector<AdviseFamily> &in_time,
                       const AdviseCandidate           &in_space,
                       const std::vector<Override>     &common,
                       AdviseRuns                      &runs,
                       Log                             &log)
  {
    if (!searched)
      return;
    constexpr unsigned int level = 1; // a few more steps than the fewest
    const AdviseCandidate &steps =
      family_of("sdirk2", in_time).candidates[level];
    method_of_trapezoid =
      cheapest_method(family_of("trapezoid", in_time).candidates[level],
                      in_space,
                      common,
                      runs);
    method_of_others = cheapest_method(steps, in_space, common, runs);

    const auto run_with = [&](const double tolerance) -> const AdviseRun & {
      return runs.run(
        in_space.name + "__" + steps.name + "__" + method_of_others + "_" +
          Text::from_number(tolerance),
        joined({common,
                in_space.settings,
                steps.settings,
                settings_of(method_of_others, tolerance, maximum_periods)}));
    };
    constexpr unsigned int tries     = 4;
    bool                   confirmed = false;
    for (unsigned int k = 0; k < tries && !confirmed; ++k)
      {
        if (k > 0)
          tolerance /= 4.;
        const AdviseRun &tight = run_with(tolerance / 100.);
        if (!tight.usable())
          break;
        confirmed = runs.difference(run_with(tolerance), tight) <=
                    part_of_tolerance * target;
      }
    log.line("  periodic state: " + method_of_others +
             " with Tolerance = " + Text::from_number(tolerance) +
             (confirmed ? "" : ", not confirmed by a tighter one") +
             "; with trapezoid " + method_of_trapezoid);
  }



  std::string
  AdvisePeriod::cheapest_method(const AdviseCandidate       &in_time,
                                const AdviseCandidate       &in_space,
                                const std::vector<Override> &common,
                                AdviseRuns                  &runs) const
  {
    std::string best, messages;
    double      least = 0.;
    for (const std::string method : {"automatic", "anderson", "march"})
      {
        const unsigned int periods =
          method == "march" ? periods_of_a_march : maximum_periods;
        const AdviseRun &run =
          runs.run(in_space.name + "__" + in_time.name + "__" + method + "_" +
                     Text::from_number(tolerance),
                   joined({common,
                           in_space.settings,
                           in_time.settings,
                           settings_of(method, tolerance, periods)}));
        // On meshes that are not as coarse, the first is hardly ever slower.
        if (run.usable() && (best.empty() || run.seconds() < clearly * least))
          {
            best  = method;
            least = run.seconds();
          }
        messages += "\n  " + method + ": " + run.result.message;
      }
    if (best.empty())
      throw NumericalError("advise: no method finds the periodic state with " +
                           in_time.text + " on the coarsest mesh." + messages);
    return best;
  }



  std::vector<Override>
  AdvisePeriod::settings_of(const std::string &method,
                            const double       tolerance,
                            const unsigned int maximum_periods) const
  {
    return {advised("Periodic state/Method=" + method),
            advised("Periodic state/Start from=rest"),
            advised("Periodic state/Tolerance=" + Text::from_number(tolerance)),
            advised("Periodic state/Maximum periods=" +
                    std::to_string(maximum_periods))};
  }



  std::string
  AdvisePeriod::method(const AdviseCandidate &in_time) const
  {
    return in_time.scheme == "trapezoid" ? method_of_trapezoid
                                         : method_of_others;
  }



  std::vector<Override>
  AdvisePeriod::settings(const AdviseCandidate &in_time,
                         const Purpose          purpose) const
  {
    if (searched)
      return settings_of(method(in_time),
                         purpose == Purpose::reference
                           ? tolerance / tighter_in_reference
                           : tolerance,
                         maximum_periods);
    if (purpose == Purpose::search)
      return {advised("Periodic state/Maximum periods=" +
                      std::to_string(search_periods))};
    return {};
  }



  double
  AdvisePeriod::times_those_of_a_search() const
  {
    return searched ? 1. : static_cast<double>(own_periods) / search_periods;
  }



  std::string
  AdvisePeriod::name(const AdviseCandidate &in_time,
                     const Purpose          purpose) const
  {
    if (searched)
      return "__" + method(in_time) + "_" +
             Text::from_number(purpose == Purpose::reference
                                 ? tolerance / tighter_in_reference
                                 : tolerance);
    return "__" +
           std::to_string(purpose == Purpose::search ? search_periods
                                                     : own_periods) +
           "_periods";
  }



  std::string
  AdvisePeriod::text(const AdviseCandidate &in_time) const
  {
    return searched ? "periodic state by " + method(in_time) +
                        " with Tolerance = " + Text::from_number(tolerance)
                    : std::to_string(own_periods) +
                        (own_periods == 1 ? " period" : " periods");
  }
} // namespace Crevasse
