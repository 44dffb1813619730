// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/parameters/boundary_roles.h>
#include <crevasse/parameters/checker.h>
#include <crevasse/parameters/parameters.h>

#include <map>

namespace Crevasse
{
  void
  BoundaryParameters::check(Problems &problems) const
  {
    const Checker checker(section, problems);

    std::map<dealii::types::boundary_id, std::string> role_of;
    const auto check_ids = [&](const char *name, const std::string &value) {
      checker.demand_readable(name, value, [&]() {
        const auto ids = parse_boundary_ids(value);
        if (!ids)
          return;
        for (const auto id : *ids)
          {
            const auto [role, is_new] = role_of.emplace(id, name);
            checker.demand(is_new,
                           name,
                           value,
                           "the boundary id " + std::to_string(id) +
                             " must have one role only; " + role->second +
                             " names it as well");
          }
      });
    };
    check_ids("Clamped", clamped);
    check_ids("Symmetry", symmetry);
    check_ids("Loaded", loaded);
    check_ids("Contact", contact);

    checker.demand_valid("Gap", gap);
    if (!gap.is_valid())
      return;
    checker.demand(!gap->depends_on_time(),
                   "Gap",
                   gap.text(),
                   "must not depend on t");
    checker.demand(!gap->is_constant() || gap->value(dealii::Point<2>()) <= 0.,
                   "Gap",
                   gap.text(),
                   "must be at most 0: the lip moves away from the crack plane "
                   "only");
  }
} // namespace Crevasse
