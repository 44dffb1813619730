// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/kernels/cell_kernels.h>

#include <cstdlib>
#include <initializer_list>

namespace Crevasse
{
  bool
  has_lane_width(const unsigned int bytes)
  {
#ifdef CREVASSE_WITH_AVX
    if (bytes == 32)
      return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
    if (bytes == 64)
      return __builtin_cpu_supports("avx512f") &&
             __builtin_cpu_supports("avx512dq");
#endif
    return bytes == 16;
  }



  namespace
  {
    unsigned int
    initial_width()
    {
      const char *const  wanted  = std::getenv("CREVASSE_LANE_BYTES");
      const unsigned int at_most = wanted == nullptr ? 64 : std::atoi(wanted);
      for (const unsigned int bytes : {64, 32})
        if (bytes <= at_most && has_lane_width(bytes))
          return bytes;
      return 16;
    }

    unsigned int &
    width_in_force()
    {
      static unsigned int bytes = initial_width();
      return bytes;
    }
  } // namespace



  void
  set_lane_width(const unsigned int bytes)
  {
    width_in_force() = bytes;
  }



  template <typename Real>
  CellKernels<Real>
  cell_kernels(const CellKind &kind)
  {
#ifdef CREVASSE_WITH_AVX
    if (width_in_force() == 64)
      return kernels_of_width<64, Real>(kind);
    if (width_in_force() == 32)
      return kernels_of_width<32, Real>(kind);
#endif
    return kernels_of_width<16, Real>(kind);
  }



  template CellKernels<float>
  cell_kernels(const CellKind &);
  template CellKernels<double>
  cell_kernels(const CellKind &);
} // namespace Crevasse
