// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/text.h>
#include <crevasse/base/text_file.h>
#include <crevasse/crack_tip/growth_law.h>

#include <algorithm>
#include <cmath>

namespace Crevasse
{
  namespace
  {
    /** 1 − R, at most 1: K < 0 counts as 0. Of mixed modes the equivalent range
     * may exceed the largest value. */
    double
    range_in_largest(const TipHistory &history)
    {
      return std::min(history.range / history.largest, 1.);
    }



    double
    walker_growth(const GrowthConstants &law,
                  const double           range,
                  const TipHistory      &history)
    {
      const double m = law.paris_exponent, K_th = law.paris_threshold;
      if (range <= K_th)
        return 0.;
      double growth =
        law.paris_factor * std::pow(range, m) *
        std::pow(range_in_largest(history), (law.walker_exponent - 1.) * m);
      if (K_th > 0. && law.threshold_exponent > 0.)
        growth *= -std::expm1(law.threshold_exponent * (1. - range / K_th));
      if (law.toughness == 0.)
        return growth;
      const double rest  = 1. - history.largest / law.toughness,
                   delta = law.toughness_exponent;
      return growth / (delta > 0. ? -std::expm1(-delta * rest) : rest);
    }



    bool
    reaches_toughness(const GrowthConstants &constants,
                      const TipHistory      &history)
    {
      return constants.toughness > 0. && history.largest >= constants.toughness;
    }



    /** The formula of a constant in the description of a law. */
    std::string
    text_of(const Formula &constant)
    {
      return constant->is_constant()
               ? Text::from_number(constant->value(dealii::Point<2>()))
               : '(' + constant->formula() + ')';
    }



    double
    fatigue_growth(const CrackTipParameters &law, const TipHistory &history)
    {
      const GrowthConstants constants = law.constants(history.temperature);
      if (reaches_toughness(constants, history))
        return std::numeric_limits<double>::infinity();
      const double range = law.growth_range == GrowthRange::whole
                             ? history.range
                             : history.effective_range;
      if (range == 0.) // R of a closed crack is not known
        return 0.;
      switch (traits(law.growth_law).fatigue)
        {
          case FatigueLaw::paris: // NaN propagates
            return constants.paris_factor *
                   std::pow(std::max(range - constants.paris_threshold, 0.),
                            constants.paris_exponent);
          case FatigueLaw::walker:
            return walker_growth(constants, range, history);
          case FatigueLaw::table:
            return law.table->growth(range, 1. - range_in_largest(history));
          default:
            return 0.;
        }
    }



    double
    creep_growth(const CrackTipParameters &law, const TipHistory &history)
    {
      const auto speed = [&law](const double driver, const double temperature) {
        const GrowthConstants constants = law.constants(temperature);
        return constants.creep_factor *
               std::pow(driver, constants.creep_exponent);
      };
      if (needs_c_star(law))
        return history.c_star ? speed(*history.c_star, history.temperature) *
                                  history.period()
                              : std::numeric_limits<double>::quiet_NaN();
      const auto temperature = [&history](const std::size_t k) {
        return history.temperatures.empty() ? 0. : history.temperatures[k];
      };
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
                    (speed(std::max(begin, 0.), temperature(k - 1)) +
                     speed(std::max(end, 0.), temperature(k)));
        }
      return length;
    }
  } // namespace



  std::string
  describe_growth_law(const CrackTipParameters &law)
  {
    const auto       &parts = traits(law.growth_law);
    std::string       text;
    const std::string range =
      law.growth_range == GrowthRange::whole ? "dK" : "dK_eff";
    const std::string C = "da/dN = " + text_of(law.paris_factor) + " ",
                      m = "^" + text_of(law.paris_exponent);
    if (parts.fatigue == FatigueLaw::paris)
      text = C +
             (!law.paris_threshold->is_zero()
                ? "(" + range + " - " + text_of(law.paris_threshold) + ")"
                : range) +
             m;
    else if (parts.fatigue == FatigueLaw::walker)
      text = C + range + m +
             (text_of(law.walker_exponent) != "1" ? " f_R" : "") +
             (!law.paris_threshold->is_zero() ? " f_th" : "") +
             (!law.toughness->is_zero() ? " / f_c" : "");
    else if (parts.fatigue == FatigueLaw::table)
      text = "da/dN of " +
             law.growth_table.substr(law.growth_table.rfind('/') + 1) +
             " for " + range;
    if (parts.has_creep_part)
      text += (text.empty() ? "da/dt = " : ", and da/dt = ") +
              text_of(law.creep_factor) + " " +
              (law.creep_parameter == CreepParameter::stress_intensity
                 ? "K"
                 : (needs_c_star(law) ? "C*" : "C(t)")) +
              "^" + text_of(law.creep_exponent);
    return text;
  }



  CrackGrowth
  growth_over_period(const CrackTipParameters &law, const TipHistory &history)
  {
    return {fatigue_growth(law, history),
            traits(law.growth_law).has_creep_part ? creep_growth(law, history)
                                                  : 0.};
  }



  void
  require_growth_constants(const CrackTipParameters &law,
                           const Temperature<2>     &temperature,
                           const dealii::Point<2>   &tip,
                           const StepList           &steps)
  {
    if (law.depend_on_temperature())
      for (unsigned int k = 0; k < steps.n_steps(); ++k)
        law.constants(temperature.value(tip, steps.instant(k)));
  }



  std::vector<CrackGrowth>
  growth_of_histories(const CrackTipParameters &law,
                      const double              period,
                      const std::string        &file_name)
  {
    const Summary drivers = Summary::parse(read_text_file(file_name));
    const auto    column  = [&drivers](const char *name) {
      std::vector<double> values;
      for (const Summary &value : drivers.at(name))
        values.push_back(value.is_null() ? TipHistory::not_known
                                         : value.get<double>());
      return values;
    };
    const auto temperatures =
      drivers.contains("theta") ? column("theta") : std::vector<double>();
    TipHistory history;
    if (drivers.contains("t"))
      {
        history.temperatures = temperatures;
        history.instants     = column("t");
        history.intensity = history.creep_integral = column("driver");
        return {growth_over_period(law, history)};
      }
    history.instants = {0., period};
    // What drives creep, if not C*, has a history of its own.
    history.intensity = history.creep_integral = {0., 0.};
    const auto largest = column("K_max"), range = column("Delta_K"),
               effective = column("Delta_K_eff"), c_star = column("C_star");
    std::vector<CrackGrowth> growth;
    for (std::size_t k = 0; k < largest.size(); ++k)
      {
        history.largest         = largest[k];
        history.range           = range[k];
        history.effective_range = effective[k];
        history.c_star          = c_star[k];
        history.temperature     = temperatures.empty() ? 0. : temperatures[k];
        growth.push_back(growth_over_period(law, history));
      }
    return growth;
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
    const CrackGrowth parts  = growth_over_period(law, history);
    const double      growth = parts.total();
    tip["growth_law"]        = text;
    tip["da_dN"]             = growth; // null if not finite
    tip["da_dN_fatigue"]     = parts.fatigue;
    tip["da_dN_creep"]       = parts.creep;
    const bool breaks =
      reaches_toughness(law.constants(history.temperature), history);
    if (!std::isfinite(growth))
      tip["no_da_dN"] =
        breaks ? "K_max reaches the Fracture toughness: the crack runs through"
               : "the growth law gives no finite growth";
    tip["da_dt"] = growth / history.period();
    if (breaks)
      log.line(title + "K_max reaches [Crack tip] Fracture toughness = " +
               law.toughness.text() + ": the crack runs through");
    else if (std::isnan(growth))
      log.line(title +
               "growth is not known: the law has no value for K_max = " +
               Text::from_number(history.largest, 5) + ", Delta K = " +
               Text::from_number(history.range, 5) + " (" + text + ")");
    else
      log.line(title + "grows by " + Text::from_number(growth, 5) +
               " a period (" + text +
               (traits(law.growth_law).fatigue != FatigueLaw::none
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
