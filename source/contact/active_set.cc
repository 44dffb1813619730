// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/contact/active_set.h>

#include <deal.II/base/mpi.h>

#include <cmath>

namespace Crevasse
{
  using namespace dealii;

  ActiveSet::ActiveSet(const SignoriniProblem &problem,
                       LinearSolver           &linear_solver,
                       const double            tolerance,
                       const double            linear_tolerance,
                       const unsigned int      maximum_iterations)
    : ContactSolver(problem, tolerance)
    , lip(problem)
    , face(problem, linear_solver, counts)
    , newton(problem, face)
    , linear_tolerance(linear_tolerance)
    , maximum_iterations(std::min(maximum_iterations, most_sets))
    , active(problem.bounds.dofs.size(), false)
    , residual(problem.diagonal())
    , correction(problem.diagonal())
  {
  }



  std::string
  ActiveSet::description() const
  {
    std::string text = "active set, conjugate gradients with " +
                       face.linear_solver().preconditioner_description();
    if (rescues > 0)
      text += ", " + std::to_string(rescues) +
              " cycles ended by a projected Newton method";
    return text;
  }



  void
  ActiveSet::start_from(const std::vector<bool> &closed_bounds)
  {
    if (closed_bounds.size() == active.size())
      active = closed_bounds;
  }



  std::string
  ActiveSet::failure_notes() const
  {
    std::string text = " Numbers of closed nodes in the last active sets: ";
    const std::size_t     n     = set_sizes.size();
    constexpr std::size_t shown = 5;
    for (std::size_t k = n > shown ? n - shown : 0; k < n; ++k)
      text += std::to_string(set_sizes[k]) + (k + 1 < n ? ", " : ".");
    if (not_reached == 0)
      return text;
    return text + " Conjugate gradients did not converge on the last " +
           std::to_string(not_reached) + (not_reached == 1 ? " set" : " sets") +
           ". Use a factorisation ([Linear solver] Type = cholesky or mumps) "
           "or, with a Poisson ratio near 0.5, [Discretisation] Volumetric "
           "strain = mean; check for moduli that differ by many orders of "
           "magnitude, and for very flat cells.";
  }



  void
  ActiveSet::hold_and_compute_residual(const Vector &right_hand_side,
                                       Vector       &solution)
  {
    const UnilateralBounds &bounds = problem.bounds;
    for (std::size_t k = 0; k < active.size(); ++k)
      if (active[k])
        solution(bounds.dofs[k]) = bounds.sign[k] * bounds.gap[k];
    problem.stiffness.vmult(residual, solution);
    residual.sadd(-1., 1., right_hand_side);
  }



  std::vector<bool>
  ActiveSet::next_set(const Vector &solution) const
  {
    const UnilateralBounds &bounds = problem.bounds;
    // Errors within the certificate must not change the set: a node with
    // neither force nor opening keeps its state.
    const double least_force = -0.5 * force_accuracy() * scales.force();
    const double least_opening =
      -0.5 * displacement_accuracy() * scales.displacement();

    std::vector<bool> next(active.size());
    for (std::size_t k = 0; k < active.size(); ++k)
      {
        const auto   i       = bounds.dofs[k];
        const double force   = -bounds.sign[k] * residual(i);
        const double opening = bounds.sign[k] * solution(i) - bounds.gap[k];
        next[k] = active[k] ? force >= least_force : opening < least_opening;
      }
    return next;
  }



  bool
  ActiveSet::is_new(const std::vector<bool> &set)
  {
    set_sizes.push_back(std::count(set.begin(), set.end(), true));
    return seen.insert(set).second;
  }



  std::size_t
  ActiveSet::iterate(const Vector &right_hand_side, Vector &solution)
  {
    seen.clear();
    set_sizes.clear();
    scale_by(right_hand_side, solution);
    is_new(lip.gathered(active));
    hold_and_compute_residual(right_hand_side, solution);

    bool exactly = false; // whether every set is solved accurately
    bool settled = false; // whether the set did not change
    not_reached  = 0;
    for (unsigned int n = 1;; ++n)
      {
        correction = residual;
        face.project(active, correction);
        const double norm   = correction.l2_norm();
        const double target = residual_target();
        // A set that a rough solution confirms is usually the right one.
        const bool last =
          exactly || settled || linear_tolerance * norm <= target;
        if (!std::isfinite(norm))
          return n;
        bool reached = true;
        if (norm > target)
          {
            reached = face.solve(active,
                                 residual,
                                 last ? target : linear_tolerance * norm,
                                 correction);
            solution += correction;
            scale_by(right_hand_side, solution);
            hold_and_compute_residual(right_hand_side, solution);
          }
        // Further sets do not help if their linear problems cannot be solved.
        constexpr unsigned int enough = 3;
        not_reached                   = reached ? 0 : not_reached + 1;
        if (not_reached == enough)
          return n;

        std::vector<bool> next = next_set(solution);
        const bool        changed =
          Utilities::MPI::max(next != active ? 1 : 0,
                              problem.stiffness.get_mpi_communicator()) > 0;
        if ((!changed && (last || !reached)) || n >= maximum_iterations)
          return n;
        settled = !changed;
        if (!changed)
          continue;
        const std::vector<bool> plain   = lip.gathered(next);
        std::vector<bool>       further = plain;
        lip.extrapolate(lip.gathered(active), further);
        if (seen.count(further) > 0)
          further = plain;
        const auto begin = further.begin() + lip.first();
        active.assign(begin, begin + active.size());
        if (!is_new(further))
          {
            if (exactly)
              {
                ++rescues;
                n += newton.solve(
                  right_hand_side,
                  solution,
                  residual_target(),
                  [&](const Vector &candidate) {
                    return is_solved(right_hand_side, candidate);
                  },
                  maximum_iterations - n);
                active = newton.held_bounds(); // start of the next problem
                return n;
              }
            // A set may recur only because earlier sets were solved roughly.
            exactly = true;
            seen    = {further};
          }
        hold_and_compute_residual(right_hand_side, solution);
      }
  }
} // namespace Crevasse
