// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/problems.h>
#include <crevasse/base/text.h>
#include <crevasse/contact/proximal_point.h>

#include <deal.II/lac/householder.h>

namespace Crevasse
{
  using namespace dealii;

  ProximalPoint::ProximalPoint(const SignoriniProblem         &problem,
                               const LAPACKFullMatrix<double> &stiffness)
    : problem(problem)
    , stiffness(stiffness)
    , sign(problem.of_all(problem.bounds.sign))
    , springs(problem.of_all(problem.springs()))
    , free_motions(sign.size(), problem.bounds.free_motions.size())
  {
    for (unsigned int m = 0; m < free_motions.n(); ++m)
      {
        const LipVector openings =
          problem.of_all(problem.bounds.free_motions[m].openings);
        for (unsigned int i = 0; i < openings.size(); ++i)
          free_motions(i, m) = openings(i);
      }
    springs.grow_or_shrink(stiffness.m());
  }



  unsigned int
  ProximalPoint::solve(LipVector        &on_lip,
                       const double      accuracy,
                       const double      negligible_force,
                       const LipProblem &solve_lip)
  {
    const LipVector loads = on_lip;
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
        n_sets += solve_lip(with_springs, on_lip);
        LipVector step = on_lip;
        step -= before;
        stiffness.vmult(forces, on_lip);
        forces -= with_springs;
        with_springs = step;
        with_springs.scale(springs);
        if (with_springs.linfty_norm() <= (k > 0 ? 1. : negligible) * accuracy)
          break;
        if (k > 0)
          require_no_escape(loads, step);
        if (k == most_steps)
          throw NumericalError(
            "The motion that contact alone stops, " +
            problem.bounds.free_motions.front().name + ", has not come to " +
            "rest after " + std::to_string(most_steps) +
            " proximal steps: the gap is too wide for the load. Reduce " +
            "[Boundary] Gap, or hold the body by Fixed points.");
        before = on_lip;
      }
    n_undetermined += leave_motions_free(forces, negligible_force) ? 1 : 0;
    return n_sets;
  }



  bool
  ProximalPoint::leave_motions_free(const LipVector &forces,
                                    const double     negligible) const
  {
    const unsigned int n_motions = free_motions.n();
    FullMatrix<double> gram(n_motions); // Gram matrix of pressed openings
    for (unsigned int i = 0; i < sign.size(); ++i)
      if (sign(i) * forces(i) > negligible)
        for (unsigned int a = 0; a < n_motions; ++a)
          for (unsigned int b = 0; b < n_motions; ++b)
            gram(a, b) += free_motions(i, a) * free_motions(i, b);
    LAPACKFullMatrix<double> matrix(n_motions);
    matrix = gram;
    LipVector          eigenvalues;
    FullMatrix<double> eigenvectors;
    matrix.compute_eigenvalues_symmetric(
      -1., 1e-12 * sign.size(), 0., eigenvalues, eigenvectors);
    return eigenvalues.size() > 0;
  }



  void
  ProximalPoint::require_no_escape(const LipVector &loads,
                                   const LipVector &step) const
  {
    constexpr double rounding = 1e-6;
    LipVector        openings = step;
    openings.grow_or_shrink(sign.size());
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
