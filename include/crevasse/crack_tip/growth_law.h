// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_crack_tip_growth_law_h
#define crevasse_crack_tip_growth_law_h

#include <crevasse/base/log.h>
#include <crevasse/base/summary.h>
#include <crevasse/parameters/parameters.h>
#include <crevasse/temperature/temperature.h>
#include <crevasse/time/step_list.h>

#include <limits>
#include <optional>
#include <vector>

namespace Crevasse
{
  /** History of a crack tip in the last period. */
  struct TipHistory
  {
    std::vector<double>     instants;       ///< instants from 0 to the period
    std::vector<double>     intensity;      ///< K_I, or an equivalent K
    std::vector<double>     creep_integral; ///< C(t) at instants; nan: unknown
    std::optional<double>   c_star;         ///< C* of the steady flow, if known
    std::vector<double>     temperatures;   ///< at instants; empty: 0
    static constexpr double not_known =
      std::numeric_limits<double>::quiet_NaN();
    // Negative K count as 0, except K_op.
    double largest         = not_known; ///< K_max
    double range           = not_known; ///< ΔK = K_max − K_min
    double effective_range = not_known; ///< ΔK_eff = K_max − K_op
    double temperature     = 0.;        ///< at the instant of K_max

    double
    period() const
    {
      return instants.back() - instants.front();
    }
  };

  /** Growth of a crack over a period by the parts of a law, in units of length;
   * nan if the history lacks data that the law needs. */
  struct CrackGrowth
  {
    double fatigue = 0.;
    double creep   = 0.;

    double
    total() const
    {
      return fatigue + creep;
    }
  };

  /** Describes the law for log and summary; empty without a law. */
  std::string
  describe_growth_law(const CrackTipParameters &law);

  /**
   * Growth da/dN of the crack over the period, by the parts of the law:
   *
   * - da/dN = C (ΔK − ΔK_th)^m above the threshold (Paris, Erdogan, J. Basic
   *   Eng. 85, 1963; with a threshold: Donahue et al., Int. J. Fract. Mech. 8,
   *   1972);
   * - da/dN = C ΔK^m (1 − R)^(−(1−w)m) f_th/f_c (Walker, ASTM STP 462, 1970,
   *   with the factors of CalculiX), R = 1 − ΔK/K_max, f_th = 1 − exp(ε(1 −
   *   ΔK/ΔK_th)) and f_c = 1 − exp(δ(K_max/K_c − 1)), or without ε and δ f_th =
   *   1 and f_c = 1 − K_max/K_c (Forman et al., J. Basic Eng. 89, 1967);
   * - a GrowthTable;
   * - da/dt = D C*^φ over the whole period, or D K(t)^φ or D C(t)^φ by the
   *   trapezoidal rule over the steps. Where C(t) is not known yet, as after a
   *   jump, it is taken to be what it is next, in the next period if need be;
   *   before one, what it was last.
   *
   * The constants are those at the temperature of the instant of K_max; where
   * K(t) or C(t) drive creep, those of each instant. From K_max = K_c on growth
   * by fatigue is infinite, with all laws.
   *
   * ΔK is ΔK_eff if the law's Growth range is that. A closed crack has K = 0,
   * and a crack that is being closed C(t) = 0.
   */
  CrackGrowth
  growth_over_period(const CrackTipParameters &law, const TipHistory &history);

  /** Checks the constants at the temperatures of a tip, before the run.
   * @throw SceneError if one is out of its range. */
  void
  require_growth_constants(const CrackTipParameters &law,
                           const Temperature<2>     &temperature,
                           const dealii::Point<2>   &tip,
                           const StepList           &steps);

  /**
   * Growth over periods whose drivers are in a JSON file, as lists K_max,
   * Delta_K, Delta_K_eff and C_star with null for unknown values; or, with the
   * lists t and driver, over one period with this history of K or C(t), for
   * creep alone. A list theta has the temperatures, 0 without it.
   *
   * @throw FileError
   */
  std::vector<CrackGrowth>
  growth_of_histories(const CrackTipParameters &law,
                      const double              period,
                      const std::string        &file_name);

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
