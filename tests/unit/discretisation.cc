// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

// Operators, supports, singular functions and crack modes, most on distorted
// meshes with hanging nodes.

#include <crevasse_tests/tests.h>

void
crack_modes();
void
interface_tip();
void
lip_forces();
void
operators();
void
patch_test();
void
residual_weight();
void
rigid_motions();
void
singular_functions();
void
split_cells();

int
main(int argc, char **argv)
{
  return run_tests(argc,
                   argv,
                   {{"crack_modes", crack_modes},
                    {"interface_tip", interface_tip},
                    {"lip_forces", lip_forces},
                    {"operators", operators},
                    {"patch_test", patch_test},
                    {"residual_weight", residual_weight},
                    {"rigid_motions", rigid_motions},
                    {"singular_functions", singular_functions},
                    {"split_cells", split_cells}});
}
