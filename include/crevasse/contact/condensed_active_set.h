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
   * Active set method on the unknowns of the lip, for a fixed A with a factor
   * that has them last: between forward and backward substitution, the
   * variational inequality is a small one on the lip. Costs one back-solve,
   * whether the lip is open or closed. Each rank solves the small problem.
   *
   * If A has unconstrained motions, A with weak springs at the bounds is
   * factorised. The small problem is solved a few times, with springs that are
   * relaxed in the previous solution: the proximal point method (Rockafellar,
   * SIAM J. Control Optim. 14, 1976), whose steps tend to one endless motion if
   * there is no solution.
   */
  class CondensedActiveSet : public ContactSolver
  {
  public:
    /** @param linear_solver Solver for A with the lip of the problem. */
    CondensedActiveSet(const SignoriniProblem &problem,
                       DirectSolver           &linear_solver,
                       const double            tolerance);

    std::string
    description() const override;

    /** Without unconstrained motions one factorisation gives the solution. */
    bool
    is_exact() const override
    {
      return free_motions.n() == 0;
    }

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

    /** Solves the small problem if A has unconstrained motions.
     * @return the number of sets tried.
     * @throw NumericalError if the loads do work on an unconstrained motion
     * that no bound stops. */
    unsigned int
    solve_with_springs(LipVector &on_lip);

    /** Whether these contact forces leave an unconstrained motion possible. */
    bool
    leave_motions_free(const LipVector &forces) const;

    void
    require_no_escape(const LipVector &step) const;

    DirectSolver              &linear_solver;
    const LipGraph             lip; ///< nodes of the small problem
    CondensedProblem           lip_problem;
    LipVector                  loads;
    LipVector                  sign, springs; ///< springs of all ranks
    dealii::FullMatrix<double> free_motions;  ///< one motion in each column
  };
} // namespace Crevasse

#endif
