// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_contact_projected_newton_h
#define crevasse_contact_projected_newton_h

#include <crevasse/contact/face_solver.h>

#include <functional>

namespace Crevasse
{
  /**
   * Bertsekas' projected Newton method (SIAM J. Control Optim. 20, 1982):
   * Newton steps on the face of the bounds that are met, or nearly, and
   * pressed, which themselves are pressed on by the diagonal; bent back into
   * the cone, and shortened until the energy ½qᵀAq − bᵀq decreases enough. The
   * energy falls with every step, so that nothing can repeat: it converges for
   * every symmetric positive definite A, if slower than an active set that does
   * not cycle.
   */
  class ProjectedNewton
  {
  public:
    ProjectedNewton(const SignoriniProblem &problem, FaceSolver &face);

    /**
     * @param[in,out] solution any start.
     * @param residual_norm accuracy of the linear solves (l₂).
     * @param is_solved asked before each step.
     * @return the number of steps. It also ends when the energy cannot be
     * decreased any more, or after @p maximum_steps.
     */
    unsigned int
    solve(const Vector                              &right_hand_side,
          Vector                                    &solution,
          const double                               residual_norm,
          const std::function<bool(const Vector &)> &is_solved,
          const unsigned int                         maximum_steps);

    /** The face of the last step, for each locally owned bound. */
    const std::vector<bool> &
    held_bounds() const
    {
      return held;
    }

  private:
    /** Into the cone. */
    void
    project(Vector &solution) const;

    /** The bounds that are met, or nearly, and pressed. */
    void
    find_face(const Vector &solution);

    /** Moves along the correction, bent at the bounds, by one step or the
     * fraction of it that decreases the energy enough. False if none does. */
    bool
    search_along_correction(Vector &solution);

    const SignoriniProblem &problem;
    FaceSolver             &face;
    std::vector<bool>       held;
    Vector                  residual;
    Vector                  correction;
    Vector                  trial;
    Vector                  product;
  };
} // namespace Crevasse

#endif
