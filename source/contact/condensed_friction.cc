// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/collectively.h>
#include <crevasse/base/state_archive.h>
#include <crevasse/contact/condensed_friction.h>

namespace Crevasse
{
  using namespace dealii;

  namespace
  {
    /** Places of the unknowns of each pair in SignoriniProblem::all_lip_dofs().
     * Collective. */
    std::vector<FrictionProblem::Pair>
    pairs_of(const SignoriniProblem &problem)
    {
      const std::vector<double> gaps =
        of_all_ranks(problem.stiffness.get_mpi_communicator(),
                     problem.bounds.gap);
      const auto  &tangents = problem.all_tangents().front();
      unsigned int next     = gaps.size();
      std::vector<FrictionProblem::Pair> pairs;
      for (unsigned int i = 0; i < gaps.size(); ++i)
        pairs.push_back({i,
                         tangents[i] == numbers::invalid_dof_index
                           ? numbers::invalid_unsigned_int
                           : next++,
                         gaps[i]});
      return pairs;
    }
  } // namespace



  CondensedFriction::CondensedFriction(const SignoriniProblem &problem,
                                       DirectSolver           &linear_solver,
                                       const double            tolerance)
    : ContactSolver(problem, tolerance)
    , linear_solver(linear_solver)
    , lip_problem(linear_solver.lip_stiffness(), pairs_of(problem))
    , proximal_point(problem, linear_solver.lip_stiffness())
  {
    AssertThrow(linear_solver.lip == problem.all_lip_dofs(),
                ExcMessage("The factor's lip is not that of the contact "
                           "problem."));
  }



  std::string
  CondensedFriction::description() const
  {
    std::string text =
      "condensed active set with friction, with " + linear_solver.description();
    if (lip_problem.n_rescues() > 0)
      text += ", " + std::to_string(lip_problem.n_rescues()) +
              " cycles ended by Lemke's method";
    return text;
  }



  void
  CondensedFriction::start_from(const std::vector<bool> &closed_bounds)
  {
    const std::vector<bool> closed =
      of_all_ranks(problem.stiffness.get_mpi_communicator(), closed_bounds);
    if (closed.size() != lip_problem.states.size())
      return;
    for (unsigned int i = 0; i < closed.size(); ++i)
      lip_problem.states[i] = closed[i] ? SlipState::stick : SlipState::open;
  }



  void
  CondensedFriction::serialize_states(StateArchive &archive)
  {
    std::vector<unsigned int> numbers;
    for (const SlipState state : lip_problem.states)
      numbers.push_back(static_cast<unsigned int>(state));
    archive.common(numbers);
    for (unsigned int i = 0; i < numbers.size(); ++i)
      lip_problem.states[i] = SlipState(numbers[i]);
  }



  std::size_t
  CondensedFriction::memory_consumption() const
  {
    return ContactSolver::memory_consumption() +
           lip_problem.memory_consumption();
  }



  std::size_t
  CondensedFriction::iterate(const Vector &right_hand_side, Vector &solution)
  {
    AssertThrow(friction != nullptr, ExcInternalError());
    const MPI_Comm communicator = problem.stiffness.get_mpi_communicator();
    increment.coefficients = of_all_ranks(communicator, friction->coefficients);
    increment.reference =
      of_all_ranks(communicator, friction->reference.front());
    if (proximal_point.is_needed())
      scale_by(right_hand_side, solution);
    unsigned int n_sets = 0;
    linear_solver.solve_with_lip(
      solution, right_hand_side, [&](LipVector &on_lip) {
        const Stopwatch watch("contact on the lip");
        const auto solve_lip = [this](const LipVector &c, LipVector &result) {
          return lip_problem.solve(c, increment, result);
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
