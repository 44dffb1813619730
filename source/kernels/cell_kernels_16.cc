// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#define CREVASSE_LANE_BYTES 16 // every processor
#include <crevasse/kernels/cell_kernels_lanes.h>

namespace Crevasse
{
  template <>
  CellKernels<float>
  kernels_of_16_bytes<float>(const CellKind &kind)
  {
    return find<float>(kind);
  }

  template <>
  CellKernels<double>
  kernels_of_16_bytes<double>(const CellKind &kind)
  {
    return find<double>(kind);
  }
} // namespace Crevasse
