// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_harmonic_balance_periodic_contact_problem_h
#define crevasse_harmonic_balance_periodic_contact_problem_h

#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/vector.h>

#include <complex>
#include <memory>
#include <vector>

namespace Crevasse
{
  /**
   * One-sided contact of a periodic motion, at N equidistant instants t_j of
   * the period and at all nodes i of the lip that bear a mean force ḡ > 0:
   *
   *     w_i(t_j) = w⁰_i(t_j) + (S ∗ g)_i(t_j) + c_i,
   *     0 ≤ g_i(t_j) ⟂ w_i(t_j) ≥ 0,       (1/N) Σ_j g_i(t_j) = ḡ_i
   *
   * with the forces g and one offset c a node unknown. The convolution S ∗ g
   * multiplies the harmonics n = 1 … N/2 of g by the compliances Sₙ, complex
   * symmetric matrices whose real parts are positive definite (at least the
   * elastic compliance), and takes away the mean: hence the solution g is
   * unique, and c too, where a node opens.
   */
  struct PeriodicContactProblem
  {
    /** Sₙ = factor × matrix: matrices that differ by a factor are shared. */
    struct Compliance
    {
      std::shared_ptr<const dealii::FullMatrix<std::complex<double>>> matrix;
      std::complex<double> factor = 1.;
    };

    /** S₁ … S_{N/2} (rounded down); the last one of an even N is real. */
    std::vector<Compliance> compliances;

    /** w⁰ for each instant, N of them; a mean in time only moves c. */
    std::vector<dealii::Vector<double>> openings_without_contact;

    /** ḡ > 0 for each node. */
    dealii::Vector<double> mean_forces;
  };

  /** Its solution, in units of the problem. */
  struct PeriodicContactSolution
  {
    std::vector<dealii::Vector<double>> forces;   ///< g for each instant
    std::vector<dealii::Vector<double>> openings; ///< w for each instant
    dealii::Vector<double>              offsets;  ///< c for each node
  };
} // namespace Crevasse

#endif
