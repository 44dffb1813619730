// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_time_stages_h
#define crevasse_time_stages_h

#include <crevasse/time/integrator.h>
#include <crevasse/time/step_list.h>

#include <map>

namespace Crevasse
{
  /** Quadrature of a period by the stages of its steps: instants at which a
   * scheme evaluates the rate, and their weights in the time integral. Stages
   * at the same instant count as one. */
  struct Stages
  {
    Stages() = default;

    /** @param rule of a step; without weights the trapezoidal rule. */
    Stages(const StepList &steps, TimeQuadrature rule)
    {
      const double rounding = 1e-12 * steps.period();
      if (rule.weights.empty())
        rule = {{0., 1.}, {0.5, 0.5}};
      std::map<double, double> weight_at;
      for (unsigned int k = 0; k < steps.n_steps(); ++k)
        for (unsigned int i = 0; i < rule.nodes.size(); ++i)
          {
            const double end = steps.instant(k) + rule.nodes[i] * steps.step(k);
            const double t   = rule.nodes[i] > 0. && steps.jumps_at(end)
                                 ? steps.just_before(end)
                                 : steps.within_period(end);
            const auto   known = weight_at.lower_bound(t - rounding);
            const bool   is_known =
              known != weight_at.end() && known->first <= t + rounding;
            (is_known ? known->second : weight_at[t]) +=
              rule.weights[i] * steps.step(k);
          }
      for (const auto &[t, weight] : weight_at)
        {
          instants.push_back(t);
          weights.push_back(weight);
        }
    }

    std::vector<double> instants, weights;
  };
} // namespace Crevasse

#endif
