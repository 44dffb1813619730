// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

// Fixed points of sequences and the contact problem of a periodic motion.

#include <crevasse_tests/tests.h>

void
kept_state();
void
periodic_contact();
void
periodic_methods();

int
main(int argc, char **argv)
{
  return run_tests(argc,
                   argv,
                   {{"kept_state", kept_state},
                    {"periodic_contact", periodic_contact},
                    {"periodic_methods", periodic_methods}});
}
