// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#define CREVASSE_LANE_BYTES 16 // every processor
#include <crevasse/kernels/cell_kernels_lanes.h>
