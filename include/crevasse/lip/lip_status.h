// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_lip_lip_status_h
#define crevasse_lip_lip_status_h

#include <array>
#include <string>
#include <vector>

namespace Crevasse
{
  /** Status of a lip: how much of it is in contact. */
  enum class LipStatus
  {
    open,
    partly_closed,
    closed
  };

  /** Status of a lip at an instant. Instants include the changes of status: the
   * last with one status and the first with another. */
  struct LipMoment
  {
    double    instant;
    LipStatus status;
  };

  /** Fractions of the period in which a lip is wholly and partly closed. */
  std::array<double, 2>
  closed_parts(const std::vector<LipMoment> &lip);

  /** The event that a lip becomes wholly open. */
  struct LipOpening
  {
    double      instant; ///< last instant not wholly open
    std::string why_not; ///< reason for no opening, or empty
  };

  /** Finds the last opening before an instant, in a motion of many equal
   * periods. @param instant of the largest intensity, an instant in @p lip. */
  LipOpening
  last_opening(const std::vector<LipMoment> &lip, const double instant);
} // namespace Crevasse

#endif
