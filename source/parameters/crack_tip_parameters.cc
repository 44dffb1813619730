// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/range.h>
#include <crevasse/parameters/checker.h>
#include <crevasse/parameters/crack_tip_parameters.h>

namespace Crevasse
{
  void
  CrackTipParameters::add_parameters(dealii::ParameterHandler &prm)
  {
    const NumberPattern not_negative(Ranges::not_negative);
    const NumberPattern positive(Ranges::positive);
    prm.add_parameter("Stress intensity",
                      stress_intensity,
                      "Whether crack_tip.csv has the stress intensity "
                      "factor K_I of each step.");
    add_selection("Method", method, prm);
    prm.add_parameter("Radius",
                      radius,
                      "Half the side of that square, or the larger radius of "
                      "the fit, in units of length; 0: automatic.",
                      not_negative);
    add_selection("Crack growth law", growth_law, prm);
    prm.add_parameter("Paris factor",
                      paris_factor,
                      "C, the growth of a period where dK - dK_th is 1, in "
                      "units of length / (stress sqrt(length))^m. Allowed: a "
                      "number greater than 0 where it is used",
                      not_negative);
    prm.add_parameter("Paris exponent",
                      paris_exponent,
                      "m, a pure number.",
                      positive);
    prm.add_parameter("Paris threshold",
                      paris_threshold,
                      "dK_th, in units of stress sqrt(length): the crack does "
                      "not grow below it.",
                      not_negative);
    add_selection("Creep growth parameter", creep_parameter, prm);
    prm.add_parameter("Creep factor",
                      creep_factor,
                      "D, the speed where P is 1, in units of length / time / "
                      "P^phi; P is in units of stress length / time where it "
                      "is C*, of stress sqrt(length) where it is K_I. Allowed: "
                      "a number greater than 0 where it is used",
                      not_negative);
    prm.add_parameter("Creep exponent",
                      creep_exponent,
                      "phi, a pure number.",
                      positive);
  }



  void
  CrackTipParameters::check(Problems &problems) const
  {
    const Checker checker(section, problems);
    checker.demand(growth_law == GrowthLawType::none || stress_intensity,
                   "Crack growth law",
                   "needs Stress intensity = true");
    checker.demand(!traits(growth_law).has_paris_part ||
                     Ranges::positive.contains(paris_factor),
                   "Paris factor",
                   Ranges::positive.text());
    checker.demand(!traits(growth_law).has_creep_part ||
                     Ranges::positive.contains(creep_factor),
                   "Creep factor",
                   Ranges::positive.text());
  }
} // namespace Crevasse
