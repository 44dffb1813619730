// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_contact_condensed_solver_h
#define crevasse_contact_condensed_solver_h

#include <crevasse/contact/contact_solver.h>
#include <crevasse/contact/friction_problem.h>
#include <crevasse/contact/lip_graph.h>
#include <crevasse/contact/proximal_point.h>
#include <crevasse/linear/direct_solver.h>

#include <memory>

namespace Crevasse
{
  /**
   * Active set method on the unknowns of the lip, for a fixed A with a factor
   * that has them last: between forward and backward substitution, contact is a
   * small problem on the lip, a CondensedProblem or, with friction, a
   * FrictionProblem. Costs one back-solve, whether the lip is open or closed.
   * Each rank solves the small problem.
   *
   * If A has unconstrained motions, A with weak springs at the bounds is
   * factorised, and the small problem is solved a few times: see ProximalPoint.
   */
  class CondensedSolver : public ContactSolver
  {
  public:
    /** @param linear_solver Solver for A with SignoriniProblem::all_lip_dofs().
     */
    CondensedSolver(const SignoriniProblem &problem,
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

    /** With friction, closed pairs stick in the first guess. */
    void
    start_from(const std::vector<bool> &closed_bounds) override;

    std::size_t
    memory_consumption() const override;

  protected:
    std::vector<bool>
    first_set() const override;

    void
    serialize_states(StateArchive &archive) override
    {
      lip_problem->serialize(archive);
    }

    PrincipalFactor *
    lip_factor() override
    {
      return &lip_problem->factor;
    }

    std::size_t
    iterate(const Vector &right_hand_side, Vector &solution) override;

  private:
    using LipVector = ProblemOnLip::LipVector;

    DirectSolver                 &linear_solver;
    const LipGraph                lip; ///< nodes of the small problem
    std::unique_ptr<ProblemOnLip> lip_problem;
    FrictionProblem *with_friction = nullptr; ///< lip_problem, or null
    LipVector        loads;
    ProximalPoint    proximal_point;
  };
} // namespace Crevasse

#endif
