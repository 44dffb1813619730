// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/state_archive.h>
#include <crevasse/periodic/drift_leaps.h>

#include <algorithm>

namespace Crevasse
{
  void
  DriftLeaps::clear()
  {
    *this = DriftLeaps();
  }



  double
  DriftLeaps::next(const double unexplained_part,
                   const double change,
                   const double residual)
  {
    constexpr double hardly_explained = 0.99, the_same = 0.05, like = 2.,
                     longest = 1e6;
    const bool drifts =
      unexplained_part > hardly_explained && change < the_same;
    left = leaps && !drifts;
    if (left)
      length = std::max(1., length / 2.);
    leaps = false;
    if (!drifts)
      return 0.;
    if (residual > like * drift_residual || like * residual < drift_residual)
      length = 1.;
    drift_residual = residual;
    if (length > longest)
      return 0.;
    const double result = length;
    leaps               = length > 1.;
    length *= 2.;
    return result;
  }



  bool
  DriftLeaps::has_left() const
  {
    return left;
  }



  void
  DriftLeaps::serialize(StateArchive &archive)
  {
    archive.common(length);
    archive.common(drift_residual);
    archive.common(leaps);
    archive.common(left);
  }
} // namespace Crevasse
