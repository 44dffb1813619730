// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_contact_face_solver_h
#define crevasse_contact_face_solver_h

#include <crevasse/contact/solver_statistics.h>
#include <crevasse/linear/linear_solver.h>

namespace Crevasse
{
  /**
   * Solves on a face of the cone, where some bounds hold as equations: A with
   * their rows and columns left out. Conjugate gradients run on the unknowns
   * that are left; their preconditioner is the linear solver's for all of A,
   * projected. So another face costs no set-up, and any linear solver on any
   * number of ranks will do.
   */
  class FaceSolver
  {
  public:
    /** @param counts where linear solves and their iterations are counted. */
    FaceSolver(const SignoriniProblem &problem,
               LinearSolver           &linear_solver,
               SolverStatistics       &counts);

    /**
     * @param held for each locally owned bound whether it holds.
     * @param residual b − Aq; its held entries do not count.
     * @param residual_norm at which l₂ norm of the new residual to end.
     * @param[out] correction to be added to q; zero in the held entries.
     * @return whether that was reached within 1000 iterations; if not, the
     * correction is the best there is.
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
