// ---------------------------------------------------------------------
//
// Copyright (C) 2026 by the Crevasse authors
//
// This file is part of Crevasse. It is free software; you can use it,
// redistribute it and/or modify it under the terms of the GNU Lesser
// General Public License as published by the Free Software Foundation;
// either version 2.1 of the License, or (at your option) any later version.
//
// ---------------------------------------------------------------------

#ifndef crevasse_contact_sor_sweep_h
#define crevasse_contact_sor_sweep_h

#include <crevasse/contact/signorini_problem.h>

namespace Crevasse
{
  /**
   * One sweep of point-wise successive overrelaxation in natural order, with
   * projection on the bounds (paper, §6.1; Glowinski, Lions, Trémolières 1976).
   * Works on one rank.
   */
  class SorSweep
  {
  public:
    /** @throw NumericalError on several ranks. */
    explicit SorSweep(const SignoriniProblem &problem);

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

    // A view of the rows of the matrix, no copy.
    const int    *row_starts;
    const int    *columns;
    const double *values;

    /** For each dof its bound, or −1. */
    std::vector<int> bound_of;
  };
} // namespace Crevasse

#endif
