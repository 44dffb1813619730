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
   * The primal–dual active set on all unknowns (Hintermüller, Ito and Kunisch,
   * SIAM J. Optim. 13, 2002), on any number of ranks and with any linear
   * solver. Set and solution of the last problem are where the next one
   * starts; the linear problems are solved no better than the next set needs.
   * If a set comes back, a projected Newton method finishes, which cannot
   * cycle.
   */
  class ActiveSet : public ContactSolver
  {
  public:
    /**
     * @param linear_tolerance the factor by which the residual is reduced
     * before the set is looked at again.
     * @param maximum_iterations the largest number of sets for one problem,
     * and steps of the projected Newton method; more than 200 are in vain.
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

    /** b − Aq, with the bounds of the set as equations. */
    void
    hold_and_compute_residual(const Vector &right_hand_side, Vector &solution);

    /** The set that forces and openings call for. */
    std::vector<bool>
    next_set(const Vector &solution) const;

    /** Notes a set of all ranks; false if it was there before. */
    bool
    is_new(const std::vector<bool> &set);

    const LipGraph     lip;
    FaceSolver         face;
    ProjectedNewton    newton;
    const double       linear_tolerance;
    const unsigned int maximum_iterations;

    std::vector<bool> active; ///< for each locally owned bound
    Vector            residual;
    Vector            correction;

    std::set<std::vector<bool>> seen; ///< sets of this solve, of all ranks
    std::vector<unsigned int>   set_sizes;
    unsigned int                rescues     = 0;
    unsigned int                not_reached = 0; ///< last sets of this solve
  };
} // namespace Crevasse

#endif
