// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/text.h>
#include <crevasse/crack_tip/growth_law.h>

#include <algorithm>
#include <cmath>

namespace Crevasse
{
  namespace
  {
    double
    creep_growth(const CrackTipParameters &law, const TipHistory &history)
    {
      const auto speed = [&law](const double driver) {
        return law.creep_factor * std::pow(driver, law.creep_exponent);
      };
      if (needs_c_star(law))
        return history.c_star ? speed(*history.c_star) * history.period()
                              : std::numeric_limits<double>::quiet_NaN();
      const std::vector<double> &driver =
        law.creep_parameter == CreepParameter::C_of_t ? history.creep_integral
                                                      : history.intensity;
      const auto known = [](const double value) { return !std::isnan(value); };
      // The next period equals this one.
      std::vector<double> two_periods = driver;
      two_periods.insert(two_periods.end(), driver.begin(), driver.end());
      double length = 0.;
      for (std::size_t k = 1; k < driver.size(); ++k)
        {
          // Unknown values: take the last one before a jump, the next after it.
          const double begin = *std::find_if(two_periods.begin() + k - 1,
                                             two_periods.end() - 1,
                                             known);
          const double end   = known(driver[k]) ? driver[k] : begin;
          length += 0.5 * (history.instants[k] - history.instants[k - 1]) *
                    (speed(std::max(begin, 0.)) + speed(std::max(end, 0.)));
        }
      return length;
    }
  } // namespace



  std::string
  describe_growth_law(const CrackTipParameters &law)
  {
    const auto &parts = traits(law.growth_law);
    std::string text;
    if (parts.has_paris_part)
      text = "da/dN = " + Text::from_number(law.paris_factor) +
             (law.paris_threshold > 0.
                ? " (dK - " + Text::from_number(law.paris_threshold) + ")"
                : " dK") +
             "^" + Text::from_number(law.paris_exponent);
    if (parts.has_creep_part)
      text += (text.empty() ? "da/dt = " : ", and da/dt = ") +
              Text::from_number(law.creep_factor) + " " +
              (law.creep_parameter == CreepParameter::stress_intensity
                 ? "K"
                 : (needs_c_star(law) ? "C*" : "C(t)")) +
              "^" + Text::from_number(law.creep_exponent);
    return text;
  }



  double
  growth_over_period(const CrackTipParameters &law, const TipHistory &history)
  {
    const auto &parts = traits(law.growth_law);
    return (parts.has_paris_part // NaN propagates
              ? law.paris_factor *
                  std::pow(std::max(history.range - law.paris_threshold, 0.),
                           law.paris_exponent)
              : 0.) +
           (parts.has_creep_part ? creep_growth(law, history) : 0.);
  }



  void
  summarise_growth(const CrackTipParameters &law,
                   const TipHistory         &history,
                   const std::string        &title,
                   Summary                  &tip,
                   Log                      &log)
  {
    if (law.growth_law == GrowthLawType::none)
      return;
    const std::string text   = describe_growth_law(law);
    const double      growth = growth_over_period(law, history);
    tip["growth_law"]        = text;
    tip["da_dN"]             = growth; // null if not finite
    if (!std::isfinite(growth))
      tip["no_da_dN"] = "the growth law gives no finite growth";
    tip["da_dt"] = growth / history.period();
    log.line(title + "grows by " + Text::from_number(growth, 5) +
             " a period (" + text +
             (traits(law.growth_law).has_paris_part
                ? "; in dK, K < 0 counts as 0)"
                : ")"));
  }



  bool
  needs_c_star(const CrackTipParameters &law)
  {
    return traits(law.growth_law).has_creep_part &&
           law.creep_parameter == CreepParameter::C_star;
  }
} // namespace Crevasse
