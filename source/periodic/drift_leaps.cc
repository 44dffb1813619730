// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/periodic/drift_leaps.h>

#include <algorithm>

namespace Crevasse
{
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

} // namespace Crevasse
