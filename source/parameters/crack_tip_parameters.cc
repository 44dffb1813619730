// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/parameters/checker.h>
#include <crevasse/parameters/crack_tip_parameters.h>

#include <deal.II/base/patterns.h>

namespace Crevasse
{
  using namespace dealii;

  void
  CrackTipParameters::add_parameters(ParameterHandler &prm)
  {
    const Patterns::Double number;
    prm.add_parameter("Stress intensity",
                      stress_intensity,
                      "Whether crack_tip.csv has the stress intensity "
                      "factor K_I of each step.");
    add_selection("Method", method, prm);
    prm.add_parameter("Radius",
                      radius,
                      "Half the side of that square, or the larger radius of "
                      "the fit, in units of length; 0: automatic. Allowed: a "
                      "number of at least 0",
                      number);
    add_selection("Crack growth law", growth_law, prm);
    prm.add_parameter(
      "Paris factor",
      paris_factor,
      "C, the growth of a period where dK - dK_th is 1, in units "
      "of length / (stress sqrt(length))^m. Allowed: a number "
      "greater than 0 where it is used",
      number);
    prm.add_parameter("Paris exponent",
                      paris_exponent,
                      "m, a pure number. Allowed: a number greater than 0",
                      number);
    prm.add_parameter("Paris threshold",
                      paris_threshold,
                      "dK_th, in units of stress sqrt(length): the crack does "
                      "not grow below it. Allowed: a number of at least 0",
                      number);
    add_selection("Creep growth parameter", creep_parameter, prm);
    prm.add_parameter("Creep factor",
                      creep_factor,
                      "D, the speed where P is 1, in units of length / time / "
                      "P^phi; P is in units of stress length / time where it "
                      "is C*, of stress sqrt(length) where it is K_I. Allowed: "
                      "a number greater than 0 where it is used",
                      number);
    prm.add_parameter("Creep exponent",
                      creep_exponent,
                      "phi, a pure number. Allowed: a number greater than 0",
                      number);
  }



  void
  CrackTipParameters::check(Problems &problems) const
  {
    const Checker checker(section, problems);
    checker.demand(radius >= 0., "Radius", radius, "must be at least 0");
    checker.demand(growth_law == GrowthLawType::none || stress_intensity,
                   "Crack growth law",
                   name_of(growth_law),
                   "needs Stress intensity = true");
    if (traits(growth_law).has_paris_part)
      checker.demand_positive("Paris factor", paris_factor);
    if (traits(growth_law).has_creep_part)
      checker.demand_positive("Creep factor", creep_factor);
    checker.demand_positive("Paris exponent", paris_exponent);
    checker.demand_positive("Creep exponent", creep_exponent);
    checker.demand(paris_threshold >= 0.,
                   "Paris threshold",
                   paris_threshold,
                   "must be at least 0");
  }
} // namespace Crevasse
