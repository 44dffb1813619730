// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_contact_point_sweep_h
#define crevasse_contact_point_sweep_h

#include <crevasse/contact/sweep.h>
#include <crevasse/linear/matrix_rows.h>

#include <vector>

namespace Crevasse
{
  /** Unknown by unknown: the paper's method (§6.1; Glowinski, Lions,
   * Trémolières 1976). */
  class PointSweep : public Sweep
  {
  public:
    explicit PointSweep(const SignoriniProblem &problem);

    double
    operator()(const Vector &right_hand_side,
               Vector       &solution,
               const double  relaxation_factor) const override;

  private:
    const SignoriniProblem &problem;
    const MatrixRows        rows;
    std::vector<int>        bound_of; ///< for each unknown its bound, or −1
  };
} // namespace Crevasse

#endif
