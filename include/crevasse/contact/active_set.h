// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_contact_active_set_h
#define crevasse_contact_active_set_h

#include <crevasse/contact/contact_solver.h>
#include <crevasse/contact/lip_graph.h>
#include <crevasse/contact/projected_newton.h>

#include <set>

namespace Crevasse
{
  /**
   * Primal–dual active set method on all unknowns (Hintermüller, Ito and
   * Kunisch, SIAM J. Optim. 13, 2002), on any number of ranks and with any
   * linear solver. Starts from the set and the solution of the last problem;
   * solves linear problems only as accurately as the next set needs. If a set
   * recurs, a projected Newton method finishes, which cannot cycle.
   */
  class ActiveSet : public ContactSolver
  {
  public:
    /**
     * @param linear_tolerance Reduction of the residual before the set is
     * updated.
     * @param maximum_iterations Largest number of sets for one problem, and of
     * steps of the projected Newton method; more than 200 sets do not help.
     */
    ActiveSet(const SignoriniProblem &problem,
              LinearSolver           &linear_solver,
              const double            tolerance,
              const double            linear_tolerance,
              const unsigned int      maximum_iterations);

    std::string
    description() const override;

    void
    start_from(const std::vector<bool> &closed_bounds) override;

  protected:
    std::vector<bool>
    first_set() const override
    {
      return active;
    }

    std::size_t
    iterate(const Vector &right_hand_side, Vector &solution) override;

    std::string
    failure_notes() const override;

  private:
    static constexpr unsigned int most_sets = 200;

    /** Computes b − Aq, with the bounds of the active set as equations. */
    void
    hold_and_compute_residual(const Vector &right_hand_side, Vector &solution);

    /** Next active set, from contact forces and openings. */
    std::vector<bool>
    next_set(const Vector &solution) const;

    /** Stores a set of all ranks; false if it was there before. */
    bool
    is_new(const std::vector<bool> &set);

    const LipGraph     lip;
    FaceSolver         face;
    ProjectedNewton    newton;
    const double       linear_tolerance;
    const unsigned int maximum_iterations;

    std::vector<bool> active; ///< flag of each locally owned bound
    Vector            residual;
    Vector            correction;

    std::set<std::vector<bool>> seen; ///< all ranks' sets in this solve
    std::vector<unsigned int>   set_sizes;
    unsigned int                rescues     = 0;
    unsigned int                not_reached = 0; ///< sets not solved, in a row
  };
} // namespace Crevasse

#endif
