// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_tests_lane_widths_h
#define crevasse_tests_lane_widths_h

#include <crevasse/kernels/cell_kernels.h>

/** Calls f() with cell kernels of each width that the processor has; the widest
 * remains. */
template <typename Function>
void
for_each_lane_width(const Function &f)
{
  for (const unsigned int bytes : {16, 32, 64})
    if (Crevasse::has_lane_width(bytes))
      {
        Crevasse::set_lane_width(bytes);
        f();
      }
}

#endif
