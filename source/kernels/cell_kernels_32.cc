// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#define CREVASSE_LANE_BYTES 32 // AVX2 with FMA
#include <crevasse/kernels/cell_kernels_lanes.h>
