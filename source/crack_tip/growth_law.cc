// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/text.h>
#include <crevasse/crack_tip/growth_law.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace Crevasse
{
  double
  TipHistory::period() const
  {
    return instants.back() - instants.front();
  }



  double
  TipHistory::largest() const
  {
    return *std::max_element(intensity.begin(), intensity.end());
  }



  double
  TipHistory::least() const
  {
    return *std::min_element(intensity.begin(), intensity.end());
  }



  ParisLaw::ParisLaw(const double factor,
                     const double exponent,
                     const double threshold)
    : factor(factor)
    , exponent(exponent)
    , threshold(threshold)
  {
  }



  double
  ParisLaw::per_cycle(const TipHistory &history) const
  {
    const double range =
      std::max(history.largest(), 0.) - std::max(history.least(), 0.);
    return range > threshold ? factor * std::pow(range - threshold, exponent)
                             : 0.;
  }



  std::string
  ParisLaw::description() const
  {
    const std::string range =
      threshold > 0. ? "(dK - " + Text::from_number(threshold) + ")" : "dK";
    return "da/dN = " + Text::from_number(factor) + " " + range + "^" +
           Text::from_number(exponent);
  }



  CreepLaw::CreepLaw(const double factor, const double exponent)
    : factor(factor)
    , exponent(exponent)
  {
  }



  double
  CreepLaw::per_cycle(const TipHistory &history) const
  {
    if (!history.c_star)
      return std::numeric_limits<double>::quiet_NaN();
    return factor * std::pow(*history.c_star, exponent) * history.period();
  }



  std::string
  CreepLaw::description() const
  {
    return "da/dt = " + Text::from_number(factor) + " C*^" +
           Text::from_number(exponent);
  }



  IntensityCreepLaw::IntensityCreepLaw(const double factor,
                                       const double exponent)
    : factor(factor)
    , exponent(exponent)
  {
  }



  double
  IntensityCreepLaw::per_cycle(const TipHistory &history) const
  {
    const auto speed = [&](const std::size_t k) {
      return factor * std::pow(std::max(history.intensity[k], 0.), exponent);
    };
    double length = 0.;
    for (std::size_t k = 1; k < history.instants.size(); ++k)
      length += 0.5 * (history.instants[k] - history.instants[k - 1]) *
                (speed(k - 1) + speed(k));
    return length;
  }



  std::string
  IntensityCreepLaw::description() const
  {
    return "da/dt = " + Text::from_number(factor) + " K_I^" +
           Text::from_number(exponent);
  }



  SumOfLaws::SumOfLaws(std::unique_ptr<const GrowthLaw> &&one,
                       std::unique_ptr<const GrowthLaw> &&other)
    : one(std::move(one))
    , other(std::move(other))
  {
  }



  double
  SumOfLaws::per_cycle(const TipHistory &history) const
  {
    return one->per_cycle(history) + other->per_cycle(history);
  }



  std::string
  SumOfLaws::description() const
  {
    return one->description() + ", and " + other->description();
  }



  std::unique_ptr<const GrowthLaw>
  make_growth_law(const CrackTipParameters &parameters)
  {
    const auto paris = [&]() -> std::unique_ptr<const GrowthLaw> {
      return std::make_unique<const ParisLaw>(parameters.paris_factor,
                                              parameters.paris_exponent,
                                              parameters.paris_threshold);
    };
    const auto creep = [&]() -> std::unique_ptr<const GrowthLaw> {
      if (parameters.creep_parameter == CreepParameter::C_star)
        return std::make_unique<const CreepLaw>(parameters.creep_factor,
                                                parameters.creep_exponent);
      return std::make_unique<const IntensityCreepLaw>(
        parameters.creep_factor, parameters.creep_exponent);
    };
    switch (parameters.growth_law)
      {
        case GrowthLawType::none:
          return nullptr;
        case GrowthLawType::paris:
          return paris();
        case GrowthLawType::creep:
          return creep();
        case GrowthLawType::sum:
          return std::make_unique<const SumOfLaws>(paris(), creep());
      }
    AssertThrow(false, dealii::ExcInternalError());
    return nullptr;
  }



  bool
  needs_c_star(const CrackTipParameters &parameters)
  {
    return traits(parameters.growth_law).has_creep_part &&
           parameters.creep_parameter == CreepParameter::C_star;
  }
} // namespace Crevasse
