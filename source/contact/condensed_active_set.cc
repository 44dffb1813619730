// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/contact/condensed_active_set.h>

#include <deal.II/base/mpi.h>

#include <algorithm>

namespace Crevasse
{
  using namespace dealii;

  CondensedActiveSet::CondensedActiveSet(const SignoriniProblem &problem,
                                         LinearSolver           &linear_solver,
                                         const double            tolerance)
    : ContactSolver(problem, tolerance)
    , linear_solver(linear_solver)
    , lip(problem)
    , lip_problem(
        lip.n_nodes(),
        [this](const std::vector<unsigned int> &nodes) {
          return compliance_columns(nodes);
        },
        [this](const std::vector<bool> &active, std::vector<bool> &next) {
          lip.extrapolate(active, next);
        })
    , gap(problem.n_bounds())
    , opening(problem.n_bounds())
    , forces(problem.n_bounds())
  {
    if (problem.n_bounds() > 0)
      loads.reinit(problem.diagonal());
    std::copy(problem.bounds.gap.begin(),
              problem.bounds.gap.end(),
              gap.begin() + lip.first());
    lip.gather(gap.data());
  }



  std::string
  CondensedActiveSet::description() const
  {
    std::string text =
      (problem.n_bounds() > 0 ? "condensed active set with " : "no contact; ") +
      linear_solver.description();
    if (lip_problem.n_rescues() > 0)
      text += ", " + std::to_string(lip_problem.n_rescues()) +
              " cycles ended node by node";
    return text;
  }



  void
  CondensedActiveSet::start_from(const std::vector<bool> &closed_bounds)
  {
    lip_problem.start_from(lip.gathered(closed_bounds));
  }



  std::vector<bool>
  CondensedActiveSet::first_set() const
  {
    std::vector<bool> closed(problem.bounds.dofs.size(), false);
    for_each_closed(
      [&](const unsigned int k, const unsigned int) { closed[k] = true; });
    return closed;
  }



  template <typename Function>
  void
  CondensedActiveSet::for_each_closed(const Function &f) const
  {
    // Another rank's node is a number beyond the local ones.
    for (const unsigned int node : lip_problem.active_set())
      if (const unsigned int k = node - lip.first();
          k < problem.bounds.dofs.size())
        f(k, node);
  }



  std::size_t
  CondensedActiveSet::memory_consumption() const
  {
    return ContactSolver::memory_consumption() +
           lip_problem.memory_consumption() + loads.memory_consumption() +
           change.memory_consumption();
  }



  void
  CondensedActiveSet::restrict_to_lip(const Vector           &v,
                                      dealii::Vector<double> &on_lip) const
  {
    const UnilateralBounds &bounds = problem.bounds;
    for (unsigned int k = 0; k < bounds.dofs.size(); ++k)
      on_lip(lip.first() + k) = bounds.sign[k] * v(bounds.dofs[k]);
    lip.gather(on_lip.data());
  }



  std::vector<dealii::Vector<double>>
  CondensedActiveSet::compliance_columns(const std::vector<unsigned int> &nodes)
  {
    // As many columns at once as a dense block of right-hand sides pays for;
    // the block is what limits the memory.
    constexpr std::size_t               block_size = 32;
    std::vector<dealii::Vector<double>> columns;
    for (std::size_t begin = 0; begin < nodes.size(); begin += block_size)
      {
        const std::size_t   m = std::min(block_size, nodes.size() - begin);
        std::vector<Vector> unit_loads(m, problem.diagonal());
        for (std::size_t k = 0; k < m; ++k)
          {
            unit_loads[k] = 0.;
            // As above: of which rank the node is.
            const unsigned int bound = nodes[begin + k] - lip.first();
            if (bound < problem.bounds.dofs.size())
              unit_loads[k](problem.bounds.dofs[bound]) =
                problem.bounds.sign[bound];
          }
        linear_solver.solve(unit_loads, 0.1 * tolerance);
        for (const Vector &solution : unit_loads)
          {
            columns.emplace_back(problem.n_bounds());
            restrict_to_lip(solution, columns.back());
          }
      }
    return columns;
  }



  void
  CondensedActiveSet::add_forces_to_loads()
  {
    for_each_closed([&](const unsigned int k, const unsigned int node) {
      loads(problem.bounds.dofs[k]) += problem.bounds.sign[k] * forces(node);
    });
  }



  void
  CondensedActiveSet::close(Vector &solution) const
  {
    const UnilateralBounds &bounds = problem.bounds;
    for_each_closed([&](const unsigned int k, const unsigned int) {
      solution(bounds.dofs[k]) = bounds.sign[k] * bounds.gap[k];
    });
  }



  void
  CondensedActiveSet::refine(const Vector &right_hand_side, Vector &solution)
  {
    // A solution for given forces has the rounding of a back-solve at the
    // closed nodes, however often it is refined; moved away from there it would
    // leave forces out of balance, large ones on flat cells. So the nodes stay
    // where they are, and what is out of balance elsewhere is solved for.
    const UnilateralBounds &bounds = problem.bounds;
    loads.reinit(solution, true);
    problem.stiffness.vmult(loads, solution);
    loads.sadd(-1., 1., right_hand_side);
    for_each_closed([&](const unsigned int k, const unsigned int) {
      loads(bounds.dofs[k]) = 0.;
    });

    change.reinit(solution, true);
    linear_solver.solve(change, loads, residual_target());
    if (!lip_problem.active_set().empty())
      {
        // Zero but for nodes that are to be closed now and are not yet.
        restrict_to_lip(solution, opening);
        opening -= gap;
        restrict_to_lip(change, forces);
        opening += forces;
        lip_problem.forces_that_close(opening, forces);
        add_forces_to_loads();
        linear_solver.solve(change, loads, residual_target());
      }
    solution += change;
    close(solution);
  }



  bool
  CondensedActiveSet::closes_more(const Vector &solution)
  {
    restrict_to_lip(solution, opening);
    opening -= gap;
    // Where forces are nearly zero, as without load, the rounding of the
    // columns of S has decided about the set. The refined solution knows
    // better.
    const double      depth = tolerance * solution.linfty_norm();
    std::vector<bool> closed(opening.size());
    for (const unsigned int node : lip_problem.active_set())
      closed[node] = true;
    bool more = false;
    for (unsigned int node = 0; node < closed.size(); ++node)
      if (!closed[node] && opening(node) < -depth)
        more = closed[node] = true;
    if (more)
      lip_problem.start_from(closed);
    return more;
  }



  std::size_t
  CondensedActiveSet::iterate(const Vector &right_hand_side, Vector &solution)
  {
    solve_linear(linear_solver, right_hand_side, solution);
    unsigned int n_sets = 1;
    if (problem.n_bounds() > 0)
      {
        restrict_to_lip(solution, opening);
        opening -= gap;
        n_sets = lip_problem.solve(opening, forces);
      }
    if (lip_problem.active_set().empty())
      {
        if (asks_for_refinement())
          refine(right_hand_side, solution);
        return n_sets;
      }

    loads = right_hand_side;
    add_forces_to_loads();
    solve_linear(linear_solver, loads, solution);
    // Closed is closed: no rounding of a back-solve in the gap.
    close(solution);
    constexpr unsigned int most_sets = 4;
    for (unsigned int k = 0; asks_for_refinement() && k < most_sets; ++k)
      {
        refine(right_hand_side, solution);
        if (!closes_more(solution))
          break;
        ++n_sets;
      }
    return n_sets;
  }
} // namespace Crevasse
