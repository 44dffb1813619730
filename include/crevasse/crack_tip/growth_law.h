// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_crack_tip_growth_law_h
#define crevasse_crack_tip_growth_law_h

#include <crevasse/base/log.h>
#include <crevasse/base/summary.h>
#include <crevasse/parameters/parameters.h>

#include <limits>
#include <optional>
#include <vector>

namespace Crevasse
{
  /** History of a crack tip in the last period. */
  struct TipHistory
  {
    std::vector<double>   instants;       ///< instants from 0 to the period
    std::vector<double>   intensity;      ///< K_I, or an equivalent K
    std::vector<double>   creep_integral; ///< C(t) at instants; nan: unknown
    std::optional<double> c_star;         ///< C* of the steady flow, if known
    /** Range ΔK, with K_I < 0 counted as 0. */
    double range = std::numeric_limits<double>::quiet_NaN();

    double
    period() const
    {
      return instants.back() - instants.front();
    }
  };

  /** Describes the law for log and summary; empty without a law. */
  std::string
  describe_growth_law(const CrackTipParameters &law);

  /**
   * Growth da/dN of the crack over the period, the sum of the parts of the law:
   *
   * - da/dN = C (ΔK − ΔK_th)^m above the threshold (Paris, Erdogan, J. Basic
   *   Eng. 85, 1963; with a threshold: Donahue et al., Int. J. Fract. Mech. 8,
   *   1972);
   * - da/dt = D C*^φ over the whole period, or D K(t)^φ or D C(t)^φ by the
   *   trapezoidal rule over the steps. Where C(t) is not known yet, as after a
   *   jump, it is taken to be what it is next, in the next period if need be;
   *   before one, what it was last.
   *
   * Growth is nan if the history lacks data that the law needs. A closed crack
   * has K = 0, and a crack that is being closed C(t) = 0.
   */
  double
  growth_over_period(const CrackTipParameters &law, const TipHistory &history);

  /** Adds the growth_over_period() to the summary of a tip and to the log;
   * nothing without a law.
   *
   * @param title of the line in the log. */
  void
  summarise_growth(const CrackTipParameters &law,
                   const TipHistory         &history,
                   const std::string        &title,
                   Summary                  &tip,
                   Log                      &log);

  /** Whether the law depends on C*. */
  bool
  needs_c_star(const CrackTipParameters &law);
} // namespace Crevasse

#endif
