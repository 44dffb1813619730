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
   * Newton steps on the face of active or nearly active bounds under pressure,
   * while the diagonal of A moves the unknowns of these bounds. Steps are bent
   * back into the cone, and shortened until the energy ½qᵀAq − bᵀq decreases
   * enough. The energy falls with every step, so that nothing can repeat: the
   * method converges for every symmetric positive definite A, but more slowly
   * than an active set that does not cycle.
   */
  class ProjectedNewton
  {
  public:
    ProjectedNewton(const SignoriniProblem &problem, FaceSolver &face);

    /**
     * @param[in,out] solution Any initial guess.
     * @param residual_norm Accuracy of the linear solves (l₂).
     * @param is_solved Evaluated before each step.
     * @return the number of steps. Also ends when the energy cannot be
     * decreased, or after @p maximum_steps.
     */
    unsigned int
    solve(const Vector                              &right_hand_side,
          Vector                                    &solution,
          const double                               residual_norm,
          const std::function<bool(const Vector &)> &is_solved,
          const unsigned int                         maximum_steps);

    /** Bounds in the face of the last step, for each locally owned bound. */
    const std::vector<bool> &
    held_bounds() const
    {
      return held;
    }

  private:
    /** Projects a vector into the cone of the bounds. */
    void
    project(Vector &solution) const;

    /** Finds the bounds that are active, or nearly, and under pressure. */
    void
    find_face(const Vector &solution);

    /** Line search along the correction, bent at the bounds, by one step or the
     * fraction that decreases the energy enough. False if there is none. */
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
