// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/format.h>
#include <crevasse/base/text.h>
#include <crevasse/crack_tip/crack_closure.h>

#include <cmath>

namespace Crevasse
{
  namespace
  {
    /** K at the last instant before that of the largest K at which the lip
     * becomes wholly open, or why there is none. The period is one of many. */
    std::pair<double, std::string>
    opening_intensity(const TipHistory           &history,
                      const std::vector<LipStep> &lip)
    {
      const std::vector<double> &all = history.intensity;
      const int                  n   = lip.size();
      // Those of the period before have numbers below 0.
      const auto K = [&](const int i) { return all[i < 0 ? i + n : i]; };
      const auto t = [&](const int i) {
        return i < 0 ? history.instants[i + n] - history.period()
                     : history.instants[i];
      };
      int largest = std::max_element(all.begin(), all.end()) - all.begin();
      if (largest == 0)
        largest = n;
      if (lip[largest - 1].open_to < lip[largest - 1].end)
        return {0., "the lip is not wholly open at the largest intensity"};
      for (int i = largest - 1; i >= largest - n; --i)
        {
          const LipStep &step  = lip[i < 0 ? i + n : i];
          const double   shift = t(i) - step.begin;
          // Open from within this step on, or from its end.
          const bool opens_at_end = step.open_to < step.end;
          if (!opens_at_end && step.open_from <= step.begin)
            continue;
          const double opening =
            shift + (opens_at_end ? step.end : step.open_from);
          // While the tip is closed K may be another function of time than
          // later. Both end here, but where the load jumps, or bends, one of
          // them is known far better: it is taken for less rather than more.
          const int  first = i + (opens_at_end ? 2 : 1);
          const int  other = first < largest ? first + 1 : first - 1;
          const auto line  = [&](const int a, const int b) {
            return K(a) + (K(b) - K(a)) / (t(b) - t(a)) * (opening - t(a));
          };
          const double value =
            opening > t(first - 1)
              ? std::min(line(first, other), line(first - 1, first - 2))
              : K(first - 1);
          const auto [least, most]  = std::minmax({K(first - 1), K(first)});
          constexpr double rounding = 1e-12;
          const double     bounded  = std::clamp(value, least, most);
          return {std::abs(bounded) > rounding * history.largest() ? bounded
                                                                   : 0.,
                  ""};
        }
      return {0., "the lip is open throughout the period"};
    }

  } // namespace



  std::array<double, 2>
  closed_parts(const std::vector<LipStep> &lip)
  {
    double wholly = 0., partly = 0.;
    for (const LipStep &step : lip)
      {
        const double open   = std::max(0., step.open_to - step.open_from);
        const double closed = std::max(0., step.closed_to - step.closed_from);
        wholly += closed;
        partly += std::max(0., step.end - step.begin - open - closed);
      }
    const double period = lip.back().end - lip.front().begin;
    const auto   part   = [period](const double time) {
      constexpr double rounding = 1e-10;
      return time > rounding * period ? time / period : 0.;
    };
    return {{part(wholly), part(partly)}};
  }



  void
  summarise_closure(const TipHistory           &history,
                    const std::vector<LipStep> *lip,
                    const std::string          &title,
                    Summary                    &tip,
                    Log                        &log)
  {
    const double largest = history.largest();
    const double range   = largest - history.least();
    tip["Delta_K"]       = range;
    std::string line     = title + "Delta K " + Text::from_number(range, 6);
    if (lip != nullptr && lip->size() + 1 == history.instants.size())
      {
        const auto [opening, why_not] = opening_intensity(history, *lip);
        const bool is_known           = why_not.empty();
        const auto [wholly, partly]   = closed_parts(*lip);
        const bool is_open            = wholly + partly == 0.;
        const auto known              = [](const bool on, const double value) {
          return on ? Summary(value) : Summary();
        };
        tip["K_opening"] = known(is_known, opening);
        if (!is_known)
          tip["no_K_opening"] = why_not;
        tip["Delta_K_eff"] =
          known(is_known || is_open, is_open ? range : largest - opening);
        tip["opening_ratio"] =
          known(is_known && largest > 0., opening / largest);
        tip["closed_part"] = {{"wholly", wholly}, {"partly", partly}};
        line += is_known ? Text::format(", Delta K_eff %.6g, K_op %.4g",
                                        largest - opening,
                                        opening)
                         : ", no K_op: " + why_not;
        line += Text::format(
          "; lip wholly closed for %.1f %% of the period, partly for %.1f %%",
          100. * wholly,
          100. * partly);
      }
    log.line(line);
  }
} // namespace Crevasse
