// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

// Contact solvers on random problems and on plates, against brute force and
// each other.

#include <crevasse_tests/tests.h>

void
condensed_problem();
void
friction_problem();
void
friction_in_space();
void
contact_solvers();
void
lip_shift();
void
projected_sor();

int
main(int argc, char **argv)
{
  return run_tests(argc,
                   argv,
                   {{"condensed_problem", condensed_problem},
                    {"friction_problem", friction_problem},
                    {"friction_in_space", friction_in_space},
                    {"contact_solvers", contact_solvers},
                    {"lip_shift", lip_shift},
                    {"projected_sor", projected_sor}});
}
