// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

// Orders, stability bounds and events of the integrators on ordinary
// differential equations and on one with contact.

#include <crevasse_tests/tests.h>

void
time_schemes();

int
main(int argc, char **argv)
{
  return run_tests(argc, argv, {{"time_schemes", time_schemes}});
}
