// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_contact_face_solver_h
#define crevasse_contact_face_solver_h

#include <crevasse/contact/solver_statistics.h>
#include <crevasse/linear/linear_solver.h>

namespace Crevasse
{
  /**
   * Solves linear problems on a face of the cone, where some bounds hold as
   * equations: A without their rows and columns. Conjugate gradients run on the
   * free unknowns; the preconditioner is the linear solver's for all of A,
   * projected. Another face needs no set-up, and any linear solver works on any
   * number of ranks.
   */
  class FaceSolver
  {
  public:
    /** @param counts Statistics that count linear solves and iterations. */
    FaceSolver(const SignoriniProblem &problem,
               LinearSolver           &linear_solver,
               SolverStatistics       &counts);

    /**
     * @param held Whether each locally owned bound holds as an equation.
     * @param residual b − Aq; its held entries do not count.
     * @param residual_norm l₂ norm of the new residual at which to end.
     * @param[out] correction Correction of q; zero in the held entries.
     * @return whether this norm was reached within 1000 iterations; if not, the
     * correction is the best one found.
     */
    bool
    solve(const std::vector<bool> &held,
          const Vector            &residual,
          const double             residual_norm,
          Vector                  &correction);

    /** Sets the held entries of a vector to zero. */
    void
    project(const std::vector<bool> &held, Vector &vector) const;

    const LinearSolver &
    linear_solver() const
    {
      return solver;
    }

  private:
    const SignoriniProblem &problem;
    LinearSolver           &solver;
    SolverStatistics       &counts;
    Vector                  projected_residual;
  };
} // namespace Crevasse

#endif
