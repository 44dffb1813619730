// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/creep/creep_law.h>

namespace Crevasse
{
  const CreepLaw &
  strain_hardening()
  {
    static const CreepLaw law = {
      power_law().parameters_and(
        {"Hardening exponent",
         "0",
         "Exponent m of the creep strain, whose power divides the creep rate; "
         "must not depend on t or theta",
         {0., 20., "at least 0 and at most 20"}}),
      power_law().response,
      power_law().dual_potential,
      true};
    return law;
  }
} // namespace Crevasse
