// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_contact_lemke_h
#define crevasse_contact_lemke_h

#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/vector.h>

#include <optional>

namespace Crevasse
{
  /**
   * Solves the linear complementarity problem 0 ≤ z ⟂ M z + r ≥ 0 of moderate
   * size by Lemke's method (Cottle, Pang and Stone, The Linear Complementarity
   * Problem, section 4.4): pivots on a dense tableau of n (2n + 2) numbers.
   *
   * @return z; nothing if the method ends in a ray, or after 50 n pivots.
   */
  std::optional<dealii::Vector<double>>
  lemke(const dealii::FullMatrix<double> &M, const dealii::Vector<double> &r);
} // namespace Crevasse

#endif
