// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_contact_sweep_h
#define crevasse_contact_sweep_h

#include <crevasse/contact/signorini_problem.h>
#include <crevasse/linear/matrix_rows.h>

#include <vector>

namespace Crevasse
{
  /**
   * One sweep of successive overrelaxation in natural order, unknown by
   * unknown, with projection on the bounds: the paper's method (§6.1;
   * Glowinski, Lions, Trémolières 1976). On one process only.
   */
  class Sweep
  {
  public:
    /** @param problem must outlive the sweep. */
    explicit Sweep(const SignoriniProblem &problem);

    /**
     * Overwrites @p solution by the next iterate and returns the largest
     * residual of a row when its turn came (a force; infinity if the iterate is
     * not finite). Rows that the projection holds at their bound count by what
     * they still move. It is cheap and close to, but not, the certificate.
     */
    double
    operator()(const Vector &right_hand_side,
               Vector       &solution,
               const double  relaxation_factor) const;

  private:
    const SignoriniProblem &problem;
    const MatrixRows        rows;
    std::vector<int>        bound_of; ///< for each unknown its bound, or −1
  };
} // namespace Crevasse

#endif
