// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

// What must not depend on the number of ranks.

#include <crevasse_tests/tests.h>

void
harmonic_response();
void
lip();
void
multigrid();
void
ranks();
void
state_transfer();

int
main(int argc, char **argv)
{
  return run_tests(argc,
                   argv,
                   {{"harmonic_response", harmonic_response},
                    {"lip", lip},
                    {"multigrid", multigrid},
                    {"ranks", ranks},
                    {"state_transfer", state_transfer}});
}
