// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/collectively.h>
#include <crevasse/contact/condensed_problem.h>
#include <crevasse/contact/condensed_solver.h>

namespace Crevasse
{
  using namespace dealii;

  namespace
  {
    /** Places of the unknowns of each pair in SignoriniProblem::all_lip_dofs().
     */
    std::vector<FrictionProblem::Pair>
    pairs_of(const SignoriniProblem       &problem,
             const dealii::Vector<double> &gaps)
    {
      constexpr unsigned int             none = numbers::invalid_unsigned_int;
      std::vector<FrictionProblem::Pair> pairs;
      for (unsigned int i = 0; i < gaps.size(); ++i)
        pairs.push_back({i, {{none, none}}, gaps(i)});
      unsigned int next = gaps.size();
      for (unsigned int c = 0; c < problem.all_tangents().size(); ++c)
        for (unsigned int i = 0; i < gaps.size(); ++i)
          if (problem.all_tangents()[c][i] != numbers::invalid_dof_index)
            pairs[i].tangents[c] = next++;
      return pairs;
    }



    FrictionState
    of_all(const FrictionState &local, const MPI_Comm communicator)
    {
      FrictionState all{of_all_ranks(communicator, local.coefficients), {}};
      for (const auto &along : local.reference)
        all.reference.push_back(of_all_ranks(communicator, along));
      return all;
    }
  } // namespace



  CondensedSolver::CondensedSolver(const SignoriniProblem &problem,
                                   DirectSolver           &linear_solver,
                                   const double            tolerance)
    : ContactSolver(problem, tolerance)
    , linear_solver(linear_solver)
    , lip(problem)
    , proximal_point(problem, linear_solver.lip_stiffness())
  {
    AssertThrow(linear_solver.lip == problem.all_lip_dofs(),
                ExcMessage("The factor's lip is not that of the contact "
                           "problem: give its unknowns to the constructor of "
                           "Cholesky or Mumps."));
    const auto     &stiffness = linear_solver.lip_stiffness();
    const LipVector gaps      = problem.of_all(problem.bounds.gap);
    if (problem.bounds.tangents.empty())
      lip_problem = std::make_unique<CondensedProblem>(
        stiffness,
        problem.of_all(problem.bounds.sign),
        gaps,
        [this](const std::vector<bool> &closed, std::vector<bool> &next) {
          lip.extrapolate(closed, next);
        });
    else
      {
        auto friction_problem =
          std::make_unique<FrictionProblem>(stiffness, pairs_of(problem, gaps));
        with_friction = friction_problem.get();
        lip_problem   = std::move(friction_problem);
      }
  }



  std::string
  CondensedSolver::description() const
  {
    std::string text =
      std::string("condensed active set ") +
      (with_friction != nullptr ? "with friction, with " : "with ") +
      linear_solver.description();
    if (lip_problem->n_rescues() > 0)
      text += ", " + std::to_string(lip_problem->n_rescues()) +
              " cycles ended " + lip_problem->rescue();
    return text;
  }



  void
  CondensedSolver::start_from(const std::vector<bool> &closed_bounds)
  {
    const std::vector<bool> closed =
      of_all_ranks(problem.stiffness.get_mpi_communicator(), closed_bounds);
    if (closed.size() == lip.n_nodes())
      lip_problem->start_from(closed);
  }



  std::vector<bool>
  CondensedSolver::first_set() const
  {
    const std::vector<bool> closed = lip_problem->closed_pairs();
    const auto              begin  = closed.begin() + lip.first();
    return {begin, begin + problem.bounds.dofs.size()};
  }



  std::size_t
  CondensedSolver::memory_consumption() const
  {
    return ContactSolver::memory_consumption() +
           lip_problem->memory_consumption();
  }



  std::size_t
  CondensedSolver::iterate(const Vector &right_hand_side, Vector &solution)
  {
    AssertThrow(with_friction == nullptr || friction != nullptr,
                ExcInternalError());
    if (with_friction != nullptr)
      with_friction->increment =
        of_all(*friction, problem.stiffness.get_mpi_communicator());
    if (proximal_point.is_needed())
      scale_by(right_hand_side, solution);
    unsigned int n_sets = 0;
    linear_solver.solve_with_lip(
      solution, right_hand_side, [&](LipVector &on_lip) {
        const Stopwatch watch("contact on the lip");
        const auto solve_lip = [this](const LipVector &c, LipVector &result) {
          return lip_problem->solve(c, result);
        };
        loads  = on_lip;
        n_sets = proximal_point.is_needed()
                   ? proximal_point.solve(on_lip,
                                          residual_target(),
                                          negligible_force(),
                                          solve_lip)
                   : solve_lip(loads, on_lip);
      });
    counts.undetermined = proximal_point.n_undetermined;
    return n_sets;
  }
} // namespace Crevasse
