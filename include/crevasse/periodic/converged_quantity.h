// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_periodic_converged_quantity_h
#define crevasse_periodic_converged_quantity_h

#include <crevasse/periodic/contraction.h>
#include <crevasse/time/observer.h>

#include <functional>
#include <map>

namespace Crevasse
{
  /** Quantity that ends the search for the periodic state instead of the
   * stress: its values at the samples of each period, and their estimated
   * error. */
  class ConvergedQuantity : public Observer
  {
  public:
    /** Values at a sample, the same on all ranks. Collective. */
    using Values = std::function<std::vector<double>(const Sample &)>;

    /** @param rounding within which instants are the same. */
    ConvergedQuantity(const Values &values, const double rounding)
      : values(values)
      , rounding(rounding)
    {
    }

    void
    observe(const Sample &sample) override
    {
      now[sample.instant] = values(sample);
    }

    void
    before_jump(const Sample &sample) override
    {
      observe(sample);
    }

    /** Ends a period and returns the estimated error of its values, relative to
     * the largest one, by the Contraction of their changes: at least a tenth of
     * the last change.
     *
     * @param of_stress error of a quantity that is 0 at all samples.
     * @return nan if it is unknown, as in the first periods. */
    double
    error(const double of_stress)
    {
      constexpr double part_of_change = 0.1;
      double           change = 0., largest = 0.;
      std::size_t      n_common = 0;
      for (const auto &[t, here] : now)
        {
          for (const double value : here)
            largest = std::max(largest, std::abs(value));
          const auto then = before.lower_bound(t - rounding);
          if (then == before.end() || then->first > t + rounding)
            continue;
          ++n_common;
          for (std::size_t i = 0; i < here.size(); ++i)
            change = std::max(change, std::abs(here[i] - then->second[i]));
        }
      const bool is_comparable = 4 * n_common >= 3 * now.size();
      before                   = std::move(now);
      now.clear();
      if (largest == 0.)
        return of_stress;
      const double left = contraction.add(change / largest, is_comparable);
      // std::max() returns its first argument if that is nan.
      return std::max(left, part_of_change * change / largest);
    }

    void
    serialize(StateArchive &archive) override
    {
      archive.section("converged quantity");
      contraction.serialize(archive);
      for (auto *period : {&before, &now})
        {
          std::vector<double> instants;
          for (const auto &sample : *period)
            instants.push_back(sample.first);
          archive.common(instants);
          for (const double t : instants)
            archive.common((*period)[t]);
        }
    }

  private:
    const Values values;
    const double rounding;
    Contraction  contraction;

    std::map<double, std::vector<double>> before, now; ///< by instant
  };
} // namespace Crevasse

#endif
