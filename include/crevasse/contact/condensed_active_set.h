// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_contact_condensed_active_set_h
#define crevasse_contact_condensed_active_set_h

#include <crevasse/contact/condensed_problem.h>
#include <crevasse/contact/contact_solver.h>
#include <crevasse/contact/lip_graph.h>
#include <crevasse/contact/proximal_point.h>
#include <crevasse/linear/direct_solver.h>

namespace Crevasse
{
  /**
   * Active set method on the unknowns of the lip, for a fixed A with a factor
   * that has them last: between forward and backward substitution, the
   * variational inequality is a small one on the lip. Costs one back-solve,
   * whether the lip is open or closed. Each rank solves the small problem.
   *
   * If A has unconstrained motions, A with weak springs at the bounds is
   * factorised, and the small problem is solved a few times: see ProximalPoint.
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
      return !proximal_point.is_needed();
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

    DirectSolver    &linear_solver;
    const LipGraph   lip; ///< nodes of the small problem
    CondensedProblem lip_problem;
    LipVector        loads;
    ProximalPoint    proximal_point;
  };
} // namespace Crevasse

#endif
