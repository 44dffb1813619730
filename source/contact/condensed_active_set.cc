// ---------------------------------------------------------------------
//
// Copyright (C) 2026 by the Crevasse authors
//
// This file is part of Crevasse. It is free software; you can use it,
// redistribute it and/or modify it under the terms of the GNU Lesser
// General Public License as published by the Free Software Foundation;
// either version 2.1 of the License, or (at your option) any later version.
//
// ---------------------------------------------------------------------

#include <crevasse/contact/condensed_active_set.h>
#include <crevasse/scene/problems.h>

#include <deal.II/base/mpi.h>

namespace Crevasse
{
  using namespace dealii;

  CondensedActiveSet::CondensedActiveSet(const SignoriniProblem &problem,
                                         LinearSolver           &linear_solver,
                                         const double            tolerance)
    : ContactSolver(problem, tolerance)
    , linear_solver(linear_solver)
    , lip_problem(problem.bounds.dofs.size(),
                  [this](const std::vector<unsigned int> &nodes) {
                    return compliance_columns(nodes);
                  })
    , opening(problem.bounds.dofs.size())
    , forces(problem.bounds.dofs.size())
    , loads(problem.diagonal())
  {
    if (Utilities::MPI::n_mpi_processes(problem.matrix.get_mpi_communicator()) >
        1)
      throw NumericalError(
        "The condensed active set works on one process only: start the program "
        "without mpirun.");
  }



  std::string
  CondensedActiveSet::description() const
  {
    std::string text =
      "condensed active set with " + linear_solver.description();
    if (lip_problem.n_rescues() > 0)
      text += ", " + std::to_string(lip_problem.n_rescues()) +
              " cycles ended by Lawson and Hanson's method";
    return text;
  }



  void
  CondensedActiveSet::restrict_to_lip(const Vector           &v,
                                      dealii::Vector<double> &on_lip) const
  {
    const UnilateralBounds &bounds = problem.bounds;
    for (unsigned int k = 0; k < bounds.dofs.size(); ++k)
      on_lip(k) = bounds.sign[k] * v(bounds.dofs[k]);
  }



  std::vector<dealii::Vector<double>>
  CondensedActiveSet::compliance_columns(const std::vector<unsigned int> &nodes)
  {
    // As many columns at once as a dense block of right-hand sides pays for;
    // the block is what limits the memory.
    constexpr std::size_t               block_size = 32;
    std::vector<dealii::Vector<double>> columns;
    for (std::size_t first = 0; first < nodes.size(); first += block_size)
      {
        const std::size_t   m = std::min(block_size, nodes.size() - first);
        std::vector<Vector> unit_loads(m, problem.diagonal());
        for (std::size_t k = 0; k < m; ++k)
          {
            const unsigned int node = nodes[first + k];
            unit_loads[k]           = 0.;
            unit_loads[k](problem.bounds.dofs[node]) =
              problem.bounds.sign[node];
          }
        linear_solver.solve(unit_loads);
        for (const Vector &solution : unit_loads)
          {
            columns.emplace_back(problem.bounds.dofs.size());
            restrict_to_lip(solution, columns.back());
          }
      }
    return columns;
  }



  std::size_t
  CondensedActiveSet::iterate(const Vector &right_hand_side, Vector &solution)
  {
    const UnilateralBounds &bounds = problem.bounds;

    linear_solver.solve(solution, right_hand_side);
    restrict_to_lip(solution, opening);
    for (unsigned int k = 0; k < bounds.dofs.size(); ++k)
      opening(k) -= bounds.gap[k];

    const unsigned int n_sets = lip_problem.solve(opening, forces);
    if (lip_problem.active_set().empty())
      return n_sets;

    loads = right_hand_side;
    for (const unsigned int k : lip_problem.active_set())
      loads(bounds.dofs[k]) += bounds.sign[k] * forces(k);
    linear_solver.solve(solution, loads);
    // Closed is closed: no rounding of a back-solve in the gap.
    for (const unsigned int k : lip_problem.active_set())
      solution(bounds.dofs[k]) = bounds.sign[k] * bounds.gap[k];
    return n_sets;
  }
} // namespace Crevasse
