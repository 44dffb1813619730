// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/text.h>
#include <crevasse/parameters/checker.h>
#include <crevasse/parameters/crack_tip_parameters.h>

namespace Crevasse
{
  void
  CrackTipParameters::check(Problems &problems) const
  {
    const Checker checker(section, problems);
    const auto   &law          = traits(growth_law);
    const bool    is_of_C_of_t = grows_by_C_of_t();
    checker.demand(growth_law == GrowthLawType::none ||
                     stress_intensity != StressIntensityChoice::off ||
                     is_of_C_of_t,
                   "Crack growth law",
                   "needs Stress intensity = true");
    const bool has_fatigue = law.fatigue != FatigueLaw::none;
    checker.demand(!is_of_C_of_t || (creep_integral && !has_fatigue),
                   "Creep growth parameter",
                   "C(t) needs Creep integral = true and Crack growth law = "
                   "creep");
    for (const GrowthConstant &constant : growth_constants)
      checker.demand_valid(constant.name, this->*constant.formula);
    const auto demand_factor = [&](const bool     is_used,
                                   const char    *name,
                                   const Formula &factor) {
      checker.demand(!is_used || !factor.is_valid() || !factor->is_constant() ||
                       Ranges::coefficient.contains(
                         factor->value(dealii::Point<2>())),
                     name,
                     Ranges::coefficient.text());
    };
    demand_factor(has_fatigue && law.fatigue != FatigueLaw::table,
                  "Paris factor",
                  paris_factor);
    demand_factor(law.has_creep_part, "Creep factor", creep_factor);
  }



  void
  CrackTipParameters::read_table(Problems &problems)
  {
    if (traits(growth_law).fatigue != FatigueLaw::table)
      return;
    const Checker checker(section, problems);
    checker.demand(!growth_table.empty(),
                   "Growth table",
                   "must be a file where the growth law is a table");
    if (!growth_table.empty() &&
        checker.demand_file("Growth table", growth_table))
      checker.demand_readable("Growth table", [&]() {
        table = std::make_shared<const GrowthTable>(growth_table);
      });
  }



  GrowthConstants
  CrackTipParameters::constants(const double temperature) const
  {
    GrowthConstants values{};
    for (const GrowthConstant &constant : growth_constants)
      {
        const Expression &formula = *(this->*constant.formula);
        const double      value =
          formula.value(Place<2>{dealii::Point<2>(), 0., temperature});
        if (!constant.range.contains(value))
          throw SceneError(Text::parameter(section, constant.name) + " = " +
                           formula.formula() + ": is " +
                           Text::from_number(value) +
                           " at theta = " + Text::from_number(temperature) +
                           "; it must be " + constant.range.text());
        values.*constant.value = value;
      }
    return values;
  }



  bool
  CrackTipParameters::depend_on_temperature() const
  {
    return std::any_of(std::begin(growth_constants),
                       std::end(growth_constants),
                       [this](const GrowthConstant &constant) {
                         return !(this->*constant.formula)->is_constant();
                       });
  }



  bool
  CrackTipParameters::grows_by_C_of_t() const
  {
    return traits(growth_law).has_creep_part &&
           creep_parameter == CreepParameter::C_of_t;
  }



  bool
  CrackTipParameters::needs_stress_intensity() const
  {
    return stress_intensity == StressIntensityChoice::on ||
           (growth_law != GrowthLawType::none && !grows_by_C_of_t());
  }
} // namespace Crevasse
