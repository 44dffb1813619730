// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_time_butcher_tableau_h
#define crevasse_time_butcher_tableau_h

#include <string>
#include <vector>

namespace Crevasse
{
  /** The coefficients of an explicit Runge–Kutta method. */
  struct ButcherTableau
  {
    std::string                      name;
    std::vector<double>              nodes;   ///< c, with c₁ = 0
    std::vector<std::vector<double>> matrix;  ///< a, row s has s entries
    std::vector<double>              weights; ///< b
    /** b less those of an embedded method of order 1; empty: there is none. */
    std::vector<double> error_weights;

    /** Length of the interval of the negative real axis on which the stability
     * function is at most 1 in modulus. */
    double real_stability_limit;
  };

  ButcherTableau
  euler_tableau();

  /** Heun's family with weight ρ: r + (1−ρ)Δt f + ρΔt f(r + Δt/(2ρ) f). ρ = ¾
   * is the paper's choice (§6.2.1), ½ the trapezoidal one, 1 the midpoint
   * rule. */
  ButcherTableau
  heun_tableau(const double weight);

  ButcherTableau
  rk4_tableau();
} // namespace Crevasse

#endif
