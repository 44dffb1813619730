// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/problems.h>
#include <crevasse/base/state_archive.h>
#include <crevasse/time/step_list.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <sstream>

namespace Crevasse
{
  namespace
  {
    /** Sorted, with @p others but those that rounding takes apart from some. */
    std::vector<double>
    unite(std::vector<double>        some,
          const std::vector<double> &others,
          const double               period)
    {
      const double rounding = 1e-12 * period;
      for (const double t : others)
        if (std::none_of(some.begin(), some.end(), [&](const double other) {
              return std::abs(t - other) <= rounding;
            }))
          some.push_back(t);
      std::sort(some.begin(), some.end());
      return some;
    }
  } // namespace



  double
  StepList::within_period(const double t, const double period)
  {
    // A stage may end on the period but for rounding.
    const double rest = t - period * std::floor(t / period);
    return rest >= period * (1. - 1e-14) ? 0. : rest;
  }



  StepList::StepList(const TimeIntegrationParameters &parameters,
                     const double                     period,
                     const std::vector<double>       &more)
    : uniform(parameters.step_control == StepControlType::uniform)
  {
    const bool adaptive = parameters.step_control == StepControlType::adaptive;
    std::vector<double> asked_for;
    if (!uniform)
      asked_for = parameters.steps;
    if (adaptive)
      for (const double t : more)
        asked_for.push_back(within_period(t, period));
    fixed = unite({0., period}, asked_for, period);
    if (!uniform && !adaptive)
      {
        instants = fixed;
        return;
      }
    // Computed from the step number: sums of steps would drift.
    const unsigned int n = parameters.steps_per_period;
    instants.resize(n + 1);
    for (unsigned int k = 0; k <= n; ++k)
      instants[k] = period * k / n;
    if (adaptive)
      instants = unite(fixed, instants, period);
  }



  void
  StepList::reset(const std::vector<double> &new_instants)
  {
    instants = new_instants;
  }



  void
  StepList::divide(const unsigned int k, const double t)
  {
    instants.insert(instants.begin() + k + 1, t);
  }



  void
  StepList::serialize(StateArchive &archive)
  {
    archive.common(instants);
  }



  void
  StepList::set_jumps(const std::vector<double> &new_jumps)
  {
    jumps = new_jumps;
  }



  bool
  StepList::jumps_at(const double t) const
  {
    const double rounding = 1e-12 * period();
    return std::any_of(jumps.begin(), jumps.end(), [&](const double jump) {
      return std::abs(t - jump) <= rounding;
    });
  }



  double
  StepList::just_before(const double t) const
  {
    return t - 1e-11 * period();
  }



  unsigned int
  StepList::n_steps() const
  {
    return instants.size() - 1;
  }



  double
  StepList::period() const
  {
    return instants.back();
  }



  double
  StepList::instant(const unsigned int k) const
  {
    return instants[k];
  }



  double
  StepList::step(const unsigned int k) const
  {
    return instants[k + 1] - instants[k];
  }



  double
  StepList::largest_step() const
  {
    double largest = 0.;
    for (unsigned int k = 0; k < n_steps(); ++k)
      largest = std::max(largest, step(k));
    return largest;
  }



  std::vector<double>
  StepList::survey_instants(const std::vector<double> &fractions) const
  {
    std::set<double> all;
    for (unsigned int k = 0; k < n_steps(); ++k)
      {
        all.insert(instant(k));
        all.insert(instant(k) + 0.5 * step(k));
        for (const double fraction : fractions)
          all.insert(within_period(instant(k) + fraction * step(k)));
      }
    return {all.begin(), all.end()};
  }



  unsigned int
  StepList::nearest(const double t) const
  {
    const auto closer = [t](const double a, const double b) {
      return std::abs(a - t) < std::abs(b - t);
    };
    const unsigned int k =
      std::min_element(instants.begin(), instants.end(), closer) -
      instants.begin();
    return k % n_steps();
  }



  double
  StepList::within_period(const double t) const
  {
    return within_period(t, period());
  }



  void
  StepList::require_stability(const double limit,
                              const double smallest_relaxation_time) const
  {
    const double bound   = limit * smallest_relaxation_time;
    const double largest = largest_step();
    if (largest < bound)
      return;

    std::ostringstream message;
    message << "The time step " << largest
            << " is too large: this scheme is stable below " << limit
            << " times the smallest relaxation time "
            << smallest_relaxation_time << ", that is below " << bound
            << ", whatever the mesh. ";
    const double n_needed = std::floor(period() / bound * (1 + 1e-12)) + 1.;
    constexpr unsigned int most = TimeIntegrationParameters::most_steps;
    if (!(n_needed <= most))
      message << "No number of steps is enough, for a period has at most "
              << most << " of them: that takes relaxation times above "
              << period() / (limit * most)
              << ". Look at the viscosity in [Material], at [Loads] Period and "
                 "at their units";
    else if (uniform)
      {
        const auto n = static_cast<unsigned int>(n_needed);
        message << "Use at least " << n
                << " steps: --set \"Time integration/Steps per period=" << n
                << "\"";
      }
    else
      message << "Add instants to [Time integration] Steps";
    message << "; or choose Scheme = sdirk2, which is stable with any step.";
    throw NumericalError(message.str());
  }



  void
  StepList::require_possible(const double longest_step) const
  {
    constexpr unsigned int most = TimeIntegrationParameters::most_steps;
    if (period() <= most * longest_step)
      return;
    std::ostringstream message;
    message << "The smallest relaxation time allows this scheme steps of "
            << longest_step << ", which are more than " << most
            << " in a period. Choose Scheme = sdirk2, which is stable with any "
               "step, or look at the viscosity in [Material], "
               "at [Loads] Period and at their units.";
    throw NumericalError(message.str());
  }
} // namespace Crevasse
