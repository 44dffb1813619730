// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/collectively.h>
#include <crevasse/base/problems.h>
#include <crevasse/base/text.h>
#include <crevasse/contact/condensed_active_set.h>

#include <deal.II/lac/householder.h>

namespace Crevasse
{
  using namespace dealii;

  namespace
  {
    /** Values of all bounds from the values of each rank. Collective. */
    dealii::Vector<double>
    of_all(const SignoriniProblem &problem, const std::vector<double> &local)
    {
      const std::vector<double> all =
        of_all_ranks(problem.stiffness.get_mpi_communicator(), local);
      return dealii::Vector<double>(all.begin(), all.end());
    }
  } // namespace



  CondensedActiveSet::CondensedActiveSet(const SignoriniProblem &problem,
                                         DirectSolver           &linear_solver,
                                         const double            tolerance)
    : ContactSolver(problem, tolerance)
    , linear_solver(linear_solver)
    , lip(problem)
    , lip_problem(linear_solver.lip_stiffness(),
                  of_all(problem, problem.bounds.sign),
                  of_all(problem, problem.bounds.gap),
                  [this](const std::vector<bool> &closed,
                         std::vector<bool>       &next) {
                    lip.extrapolate(closed, next);
                  })
    , sign(of_all(problem, problem.bounds.sign))
    , springs(of_all(problem, problem.springs()))
    , free_motions(lip.n_nodes(), problem.bounds.free_motions.size())
  {
    for (unsigned int m = 0; m < free_motions.n(); ++m)
      {
        const LipVector openings =
          of_all(problem, problem.bounds.free_motions[m].openings);
        for (unsigned int i = 0; i < openings.size(); ++i)
          free_motions(i, m) = openings(i);
      }
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
    if (free_motions.n() > 0)
      scale_by(right_hand_side, solution);
    unsigned int n_sets = 0;
    linear_solver.solve_with_lip(
      solution, right_hand_side, [&](LipVector &on_lip) {
        const Stopwatch watch("contact on the lip");
        loads  = on_lip;
        n_sets = free_motions.n() > 0 ? solve_with_springs(on_lip)
                                      : lip_problem.solve(loads, on_lip);
      });
    return n_sets;
  }



  unsigned int
  CondensedActiveSet::solve_with_springs(LipVector &on_lip)
  {
    // Rounding errors of the loads do work, too: a second solution is as good
    // as the certificate requires, if no better.
    constexpr double       negligible = 0.01;
    constexpr unsigned int most_steps = 100;
    unsigned int           n_sets     = 0;
    LipVector              before(loads.size()), forces(loads.size());
    for (unsigned int k = 0;; ++k)
      {
        LipVector with_springs = before;
        with_springs.scale(springs);
        with_springs += loads;
        n_sets += lip_problem.solve(with_springs, on_lip);
        LipVector step = on_lip;
        step -= before;
        linear_solver.lip_stiffness().vmult(forces, on_lip);
        forces -= with_springs;
        with_springs = step;
        with_springs.scale(springs);
        if (with_springs.linfty_norm() <=
            (k > 0 ? 1. : negligible) * residual_target())
          break;
        if (k > 0)
          require_no_escape(step);
        if (k == most_steps)
          throw NumericalError(
            "The motion that contact alone stops, " +
            problem.bounds.free_motions.front().name + ", has not come to " +
            "rest after " + std::to_string(most_steps) +
            " proximal steps: the gap is too wide for the load. Reduce " +
            "[Boundary] Gap, or hold the body by Fixed points.");
        before = on_lip;
      }
    counts.undetermined += leave_motions_free(forces) ? 1 : 0;
    return n_sets;
  }



  bool
  CondensedActiveSet::leave_motions_free(const LipVector &forces) const
  {
    const unsigned int n_motions = free_motions.n();
    // As in ContactBoundary, rounding errors of loads stop no motion.
    constexpr double   negligible = 1e-9;
    FullMatrix<double> gram(n_motions); // Gram matrix of pressed openings
    for (unsigned int i = 0; i < forces.size(); ++i)
      if (sign(i) * forces(i) >
          std::max(residual_target(), negligible * scales.force()))
        for (unsigned int a = 0; a < n_motions; ++a)
          for (unsigned int b = 0; b < n_motions; ++b)
            gram(a, b) += free_motions(i, a) * free_motions(i, b);
    LAPACKFullMatrix<double> matrix(n_motions);
    matrix = gram;
    LipVector          eigenvalues;
    FullMatrix<double> eigenvectors;
    matrix.compute_eigenvalues_symmetric(
      -1., 1e-12 * loads.size(), 0., eigenvalues, eigenvectors);
    return eigenvalues.size() > 0;
  }



  void
  CondensedActiveSet::require_no_escape(const LipVector &step) const
  {
    constexpr double rounding = 1e-6;
    LipVector        openings = step;
    openings.scale(sign);
    LipVector    parts(free_motions.n());
    const double rest =
      Householder<double>(free_motions).least_squares(parts, openings);
    if (rest > rounding * openings.l2_norm() || loads * step <= 0. ||
        *std::min_element(openings.begin(), openings.end()) <
          -rounding * openings.linfty_norm())
      return;
    parts /= parts.linfty_norm();
    std::vector<std::string> motions;
    for (unsigned int m = 0; m < parts.size(); ++m)
      if (std::abs(parts(m)) > rounding)
        motions.push_back(Text::from_number(parts(m), 3) + " x " +
                          problem.bounds.free_motions[m].name);
    throw NumericalError(
      "The loads move a part away that contact alone holds, and nothing stops "
      "it:\n  " +
      Text::join(motions, "\n  ") +
      "\nThere is no equilibrium. Let loads press the part on its lips, or "
      "hold it by [Boundary] Clamped, Symmetry or Fixed points.");
  }
} // namespace Crevasse
