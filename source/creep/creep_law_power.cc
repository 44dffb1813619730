// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/creep/creep_law.h>

#include <cmath>

namespace Crevasse
{
  namespace
  {
    CreepLaw::Response
    response(const CreepLaw::Constants &c, const double log_stress)
    {
      return {c[0] + (c[1] - 1.) * log_stress, c[1]};
    }



    CreepLaw::DualPotential
    dual_potential(const CreepLaw::Constants &c, const double log_stress)
    {
      const double order = c[1] + 1.;
      const double value = std::exp(c[0] + order * log_stress) / order;
      return {value, {{value, value * (log_stress - 1. / order)}}};
    }
  } // namespace



  const CreepLaw &
  power_law()
  {
    static const CreepLaw law = {
      {{"Creep coefficient",
        "1",
        "Factor A of the creep rate, see Viscosity, in units that give a rate "
        "in 1 / time",
        Ranges::coefficient},
       {"Creep exponent",
        "1",
        "Exponent n of the stress in the creep rate",
        Ranges::creep_exponent}},
      response,
      dual_potential};
    return law;
  }
} // namespace Crevasse
