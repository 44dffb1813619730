// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_crack_tip_crack_closure_h
#define crevasse_crack_tip_crack_closure_h

#include <array>
#include <string>
#include <vector>

namespace Crevasse
{
  /** How much of a lip is pressed. */
  enum class LipStatus
  {
    open,
    partly_closed,
    closed
  };

  /** What a lip is like at the instants of a period, those at which it changes
   * included: the last that has one status and the first that has another. */
  struct LipMoment
  {
    double    instant;
    LipStatus status;
  };

  /** The parts of the period in which a lip is closed wholly, and partly. */
  std::array<double, 2>
  closed_parts(const std::vector<LipMoment> &lip);

  /** When a lip becomes wholly open. */
  struct LipOpening
  {
    double      instant; ///< the last one at which it is not wholly open
    std::string why_not; ///< why there is none; empty: there is one
  };

  /** The last opening before an instant of a period that is one of many.
   * @param instant of the largest intensity, one of those of the lip. */
  LipOpening
  last_opening(const std::vector<LipMoment> &lip, const double instant);
} // namespace Crevasse

#endif
