// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/time/step_list.h>

#include <algorithm>
#include <cmath>

namespace Crevasse
{
  namespace
  {
    /** Whether sorted instants have one that is @p t up to rounding. */
    bool
    contains(const std::vector<double> &instants,
             const double               t,
             const double               period)
    {
      const double rounding = 1e-12 * period;
      const auto   next =
        std::lower_bound(instants.begin(), instants.end(), t - rounding);
      return next != instants.end() && *next <= t + rounding;
    }



    /** Sorted union; of values equal to rounding, keeps that of @p some. */
    std::vector<double>
    unite(std::vector<double>        some,
          const std::vector<double> &others,
          const double               period)
    {
      for (const double t : others)
        if (!contains(some, t, period))
          some.insert(std::upper_bound(some.begin(), some.end(), t), t);
      return some;
    }
  } // namespace



  StepList::StepList(const TimeIntegrationParameters &parameters,
                     const double                     period,
                     const std::vector<double>       &more,
                     const std::vector<double>       &ends)
    : instants{0., period}
  {
    const StepControlType control = parameters.step_control;
    std::vector<double>   asked_for;
    if (control != StepControlType::uniform)
      asked_for = parameters.steps;
    if (control == StepControlType::adaptive)
      for (const double t : more)
        asked_for.push_back(within_period(t));
    fixed = unite(unite(instants, ends, period), asked_for, period);
    if (control == StepControlType::list)
      {
        instants = fixed;
        return;
      }
    // Instants follow from the step number: sums of steps would drift.
    const unsigned int n = parameters.steps_per_period;
    instants.resize(n + 1);
    for (unsigned int k = 0; k <= n; ++k)
      instants[k] = period * k / n;
    // Adaptive steps divide equal steps, so as not to step over a pulse.
    if (control == StepControlType::adaptive || fixed.size() > 2)
      fixed = instants = unite(fixed, instants, period);
  }



  StepList::StepList(const Scene &scene)
    : StepList(scene.time_integration,
               scene.loads.period,
               scene.output.field_times->instants(scene.loads.period),
               scene.tables.step_ends)
  {
    if (scene.time_integration.step_control != StepControlType::adaptive)
      return;
    // Between 80 equal steps a sine differs from a line by 4e-4 of its range,
    // which the stages see. Peaks above 1 % are never missed.
    const double allowed =
      std::min(10. * scene.time_integration.relative_tolerance, 0.01);
    for (const auto &[name, table] : *scene.tables.functions)
      if (table.is_called && table.is_of_time())
        divide_at_rows(table, allowed);
    fixed = instants;
  }



  void
  StepList::divide_at_rows(const TableFunction &table, const double allowed)
  {
    for (unsigned int k = 0; k < n_steps();)
      if (const auto miss = missed_by_step(k, table);
          miss.difference > allowed && !contains(instants, miss.x, period()))
        divide_at(miss.x);
      else
        ++k;
  }



  TableFunction::Miss
  StepList::missed(const TableFunction &table) const
  {
    TableFunction::Miss worst;
    for (unsigned int k = 0; k < n_steps(); ++k)
      if (const auto miss = missed_by_step(k, table);
          miss.difference > worst.difference)
        worst = miss;
    return worst;
  }



  void
  StepList::set_jumps(const std::vector<double> &new_jumps)
  {
    jumps = new_jumps;
    fixed = unite(fixed, jumps, period());
  }



  bool
  StepList::jumps_at(const double t) const
  {
    return contains(jumps, t, period());
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
} // namespace Crevasse
