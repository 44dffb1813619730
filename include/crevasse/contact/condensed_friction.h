// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_contact_condensed_friction_h
#define crevasse_contact_condensed_friction_h

#include <crevasse/contact/contact_solver.h>
#include <crevasse/contact/friction_problem.h>
#include <crevasse/contact/proximal_point.h>
#include <crevasse/linear/direct_solver.h>

namespace Crevasse
{
  /**
   * Contact with Coulomb's friction in the plane, for a fixed A with a factor
   * that has openings and tangential jumps of the lip last: between forward and
   * backward substitution, it is a FrictionProblem. Costs one back-solve, as
   * without friction. Each rank solves the small problem.
   */
  class CondensedFriction : public ContactSolver
  {
  public:
    /** @param linear_solver Solver for A with SignoriniProblem::all_lip_dofs().
     */
    CondensedFriction(const SignoriniProblem &problem,
                      DirectSolver           &linear_solver,
                      const double            tolerance);

    std::string
    description() const override;

    bool
    is_exact() const override
    {
      return !proximal_point.is_needed();
    }

    /** Closed pairs stick in the first guess. */
    void
    start_from(const std::vector<bool> &closed_bounds) override;

    std::size_t
    memory_consumption() const override;

  protected:
    void
    serialize_states(StateArchive &archive) override;

    PrincipalFactor *
    lip_factor() override
    {
      return &lip_problem.factor;
    }

    std::size_t
    iterate(const Vector &right_hand_side, Vector &solution) override;

  private:
    using LipVector = FrictionProblem::LipVector;

    DirectSolver              &linear_solver;
    FrictionProblem            lip_problem;
    ProximalPoint              proximal_point;
    LipVector                  loads;
    FrictionProblem::Increment increment; ///< of all ranks
  };
} // namespace Crevasse

#endif
