// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/contact/condensed_active_set.h>

namespace Crevasse
{
  using namespace dealii;

  CondensedActiveSet::CondensedActiveSet(const SignoriniProblem &problem,
                                         DirectSolver           &linear_solver,
                                         const double            tolerance)
    : ContactSolver(problem, tolerance)
    , linear_solver(linear_solver)
    , lip(problem)
    , lip_problem(linear_solver.lip_stiffness(),
                  problem.of_all(problem.bounds.sign),
                  problem.of_all(problem.bounds.gap),
                  [this](const std::vector<bool> &closed,
                         std::vector<bool>       &next) {
                    lip.extrapolate(closed, next);
                  })
    , proximal_point(problem, linear_solver.lip_stiffness())
  {
    AssertThrow(linear_solver.lip == problem.all_bounded_dofs(),
                ExcMessage("The factor's lip is not that of the contact "
                           "problem: give the bounded unknowns to the "
                           "constructor of Cholesky or Mumps."));
  }



  std::string
  CondensedActiveSet::description() const
  {
    std::string text =
      "condensed active set with " + linear_solver.description();
    if (lip_problem.n_rescues() > 0)
      text += ", " + std::to_string(lip_problem.n_rescues()) +
              " cycles ended node by node";
    return text;
  }



  void
  CondensedActiveSet::start_from(const std::vector<bool> &closed_bounds)
  {
    lip_problem.closed = lip.gathered(closed_bounds);
  }



  std::vector<bool>
  CondensedActiveSet::first_set() const
  {
    const auto begin = lip_problem.closed.begin() + lip.first();
    return {begin, begin + problem.bounds.dofs.size()};
  }



  std::size_t
  CondensedActiveSet::memory_consumption() const
  {
    return ContactSolver::memory_consumption() +
           lip_problem.factor.memory_consumption();
  }



  std::size_t
  CondensedActiveSet::iterate(const Vector &right_hand_side, Vector &solution)
  {
    if (proximal_point.is_needed())
      scale_by(right_hand_side, solution);
    unsigned int n_sets = 0;
    linear_solver.solve_with_lip(
      solution, right_hand_side, [&](LipVector &on_lip) {
        const Stopwatch watch("contact on the lip");
        loads = on_lip;
        n_sets =
          proximal_point.is_needed()
            ? proximal_point.solve(on_lip,
                                   residual_target(),
                                   negligible_force(),
                                   [this](const LipVector &with_springs,
                                          LipVector       &result) {
                                     return lip_problem.solve(with_springs,
                                                              result);
                                   })
            : lip_problem.solve(loads, on_lip);
      });
    counts.undetermined = proximal_point.n_undetermined;
    return n_sets;
  }
} // namespace Crevasse
