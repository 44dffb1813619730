// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_contact_condensed_active_set_h
#define crevasse_contact_condensed_active_set_h

#include <crevasse/contact/condensed_problem.h>
#include <crevasse/contact/contact_solver.h>
#include <crevasse/contact/lip_graph.h>
#include <crevasse/linear/direct_solver.h>

#include <deal.II/lac/full_matrix.h>

namespace Crevasse
{
  /**
   * For a fixed A, whose factor is at hand, with the unknowns of the lip last:
   * between forward and backward substitution the variational inequality is a
   * small one on the lip. It costs one back-solve, whether the lip is open or
   * closed. On several ranks each solves the small problem.
   *
   * Where A has free motions, the factor is that of A and weak springs at the
   * bounds. The small problem is solved a few times, each time with springs at
   * rest where they were in the solution before: the proximal point method
   * (Rockafellar, SIAM J. Control Optim. 14, 1976), whose steps become one
   * motion without end if there is no solution.
   */
  class CondensedActiveSet : public ContactSolver
  {
  public:
    /** @param linear_solver one for A whose lip is that of the problem. */
    CondensedActiveSet(const SignoriniProblem &problem,
                       DirectSolver           &linear_solver,
                       const double            tolerance);

    std::string
    description() const override;

    void
    start_from(const std::vector<bool> &closed_bounds) override;

    std::size_t
    memory_consumption() const override;

  protected:
    std::vector<bool>
    first_set() const override;

    PrincipalFactor *
    lip_factor() override
    {
      return &lip_problem.factor;
    }

    std::size_t
    iterate(const Vector &right_hand_side, Vector &solution) override;

  private:
    using LipVector = CondensedProblem::LipVector;

    /** The small problem for the loads, where A has free motions.
     * @return the number of sets tried.
     * @throw NumericalError if the loads do work on a motion of these that no
     * bound stops. */
    unsigned int
    solve_with_springs(LipVector &on_lip);

    /** Whether these contact forces do not stop some motion without energy. */
    bool
    leave_motions_free(const LipVector &forces) const;

    void
    require_no_escape(const LipVector &step) const;

    DirectSolver              &linear_solver;
    const LipGraph             lip; ///< the nodes of the small problem
    CondensedProblem           lip_problem;
    LipVector                  loads;
    LipVector                  sign, springs; ///< of all ranks
    dealii::FullMatrix<double> free_motions;  ///< one in a column
  };
} // namespace Crevasse

#endif
