// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

// Orders, stability bounds and events of the integrators on ordinary
// differential equations and on one with contact; implicit steps of creep;
// extremes between steps.

#include <crevasse_tests/tests.h>

void
implicit_creep();
void
series_extremes();
void
time_schemes();

int
main(int argc, char **argv)
{
  return run_tests(argc,
                   argv,
                   {{"implicit_creep", implicit_creep},
                    {"series_extremes", series_extremes},
                    {"time_schemes", time_schemes}});
}
