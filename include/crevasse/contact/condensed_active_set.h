// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_contact_condensed_active_set_h
#define crevasse_contact_condensed_active_set_h

#include <crevasse/contact/condensed_problem.h>
#include <crevasse/contact/contact_solver.h>
#include <crevasse/contact/lip_graph.h>
#include <crevasse/linear/linear_solver.h>

#include <memory>
#include <vector>

namespace Crevasse
{
  /**
   * For a fixed A, whose factor is at hand: q = A⁻¹b + A⁻¹Lᵀg turns the
   * variational inequality into a small problem on the lip. It costs one
   * back-solve with the lip open and two otherwise, besides one for each node
   * that closes for the first time in a run. On several ranks each solves the
   * small problem. Without bounds it is one linear solve.
   */
  class CondensedActiveSet : public ContactSolver
  {
  public:
    CondensedActiveSet(const SignoriniProblem &problem,
                       LinearSolver           &linear_solver,
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

    std::vector<dealii::Vector<double>> *
    known_columns() override
    {
      return &lip_problem.known_columns();
    }

    std::size_t
    iterate(const Vector &right_hand_side, Vector &solution) override;

    bool
    can_refine() const override
    {
      return linear_solver.is_direct();
    }

  private:
    std::vector<dealii::Vector<double>>
    compliance_columns(const std::vector<unsigned int> &nodes);

    /** L v at the nodes of all ranks. */
    void
    restrict_to_lip(const Vector &v, dealii::Vector<double> &on_lip) const;

    /** f(k, node) for the closed nodes among the locally owned bounds k. */
    template <typename Function>
    void
    for_each_closed(const Function &f) const;

    void
    add_forces_to_loads();

    /** Puts the closed nodes where they belong. */
    void
    close(Vector &solution) const;

    /** One step of iterative refinement of all but the closed nodes. */
    void
    refine(const Vector &right_hand_side, Vector &solution);

    /** Adds to the set what penetrates in a refined solution by more than the
     * tolerance; returns whether there is anything. */
    bool
    closes_more(const Vector &solution);

    LinearSolver &linear_solver;

    const LipGraph         lip; ///< the nodes of the small problem
    CondensedProblem       lip_problem;
    dealii::Vector<double> gap;
    dealii::Vector<double> opening;
    dealii::Vector<double> forces;
    Vector                 loads;
    Vector                 change; ///< empty until a solution is refined
  };
} // namespace Crevasse

#endif
