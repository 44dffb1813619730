// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_crack_tip_crack_closure_h
#define crevasse_crack_tip_crack_closure_h

#include <crevasse/crack_tip/growth_law.h>

#include <array>

namespace Crevasse
{
  /** A lip in a step of the period. */
  struct LipStep
  {
    double begin, end;
    /** Between these instants all its nodes are open, or closed; at none if
     * the first is the later one. */
    double open_from, open_to, closed_from, closed_to;
  };

  /** The parts of the period in which a lip is closed wholly, and partly. */
  std::array<double, 2>
  closed_parts(const std::vector<LipStep> &lip);

  /**
   * What lives are computed from: ΔK, the opening intensity K_op (Elber,
   * ASTM STP 486, 1971) and ΔK_eff of the last period, and for which part of
   * it the lip is closed; for the summary of a tip and the log. K_op is K at
   * the last instant before that of K_max at which the lip becomes wholly open.
   *
   * @param lip steps between the instants of the history; null: no contact.
   * @param title of the line in the log. */
  void
  summarise_closure(const TipHistory           &history,
                    const std::vector<LipStep> *lip,
                    const std::string          &title,
                    Summary                    &tip,
                    Log                        &log);
} // namespace Crevasse

#endif
