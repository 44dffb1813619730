// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/problems.h>
#include <crevasse/base/state_archive.h>
#include <crevasse/contact/contact_solver.h>
#include <crevasse/linear/principal_factor.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/tensor.h>

#include <cmath>
#include <sstream>

namespace Crevasse
{
  namespace
  {
    /** Largest accepted error, however bad the rounding, and largest tolerance
     * of a scene. */
    constexpr double coarsest = 1e-2;
  } // namespace



  ContactSolver::ContactSolver(const SignoriniProblem &problem,
                               const double            tolerance)
    : problem(problem)
    , tolerance(tolerance)
    , residual(problem.diagonal())
  {
  }



  Certificate
  ContactSolver::certify(const Vector &right_hand_side, const Vector &solution)
  {
    const Stopwatch watch("certificates");
    scales = scales_of_solutions;
    return Crevasse::certify(
      problem, {right_hand_side, solution, friction}, scales, residual, forces);
  }



  void
  ContactSolver::solve(const Vector        &right_hand_side,
                       Vector              &solution,
                       ContactForces       &contact_forces,
                       const double         stiffness_factor,
                       const FrictionState *friction_state)
  {
    Assert(stiffness_factor > 0., dealii::ExcInternalError());
    const Stopwatch watch(problem.n_bounds() > 0 ? "contact problems"
                                                 : "elastic problems");
    scales_of_solutions.set_force_scale(load / stiffness_factor);
    if (stiffness_factor != 1.)
      {
        scaled_right_hand_side = right_hand_side;
        scaled_right_hand_side /= stiffness_factor;
      }
    const Vector &b =
      stiffness_factor == 1. ? right_hand_side : scaled_right_hand_side;

    friction                    = friction_state;
    const std::size_t n_new     = iterate(b, solution);
    const Certificate certified = certify(b, solution);
    if (!accepts(certified))
      fail(certified, n_new);
    scales_of_solutions = scales;
    ++counts.certified;
    if (problem.n_bounds() > 0)
      {
        ++counts.vi_solves;
        counts.vi_iterations += n_new;
      }
    counts.certificate.merge(certified);
    counts.accuracy =
      std::max({counts.accuracy, force_accuracy(), displacement_accuracy()});
    contact_forces = forces;
    for (double &force : contact_forces.normal)
      force *= stiffness_factor;
    for (auto &along : contact_forces.tangential)
      for (double &force : along)
        force *= stiffness_factor;
  }



  void
  ContactSolver::fail(const Certificate &certified,
                      const std::size_t  n_iterations) const
  {
    std::ostringstream message;
    message << "The contact problem was not solved to the accuracy "
            << force_accuracy() << " of forces and " << displacement_accuracy()
            << " of displacements by " << description() << " in "
            << n_iterations << " iterations. Reached: " << certified.describe()
            << '.' << failure_notes();
    if (std::max(force_accuracy(), displacement_accuracy()) > coarsest)
      message << " Rounding alone makes such errors here. Check for very flat "
                 "cells, extreme Poisson ratios, and moduli, relaxation times "
                 "or lengths that differ by many orders of magnitude; if the "
                 "body flows far, set [Periodic state] Secular split = on.";
    else
      message << " If \"projected sor\" or \"active set\" took as many "
                 "iterations as [Contact] Maximum iterations allows, raise it; "
                 "otherwise try another [Contact] Solver or [Linear solver] "
                 "Type (\"amg\" and \"gmg\" have the smallest rounding errors, "
                 "but no singular functions), or a larger [Contact] Tolerance.";
    throw NumericalError(message.str());
  }



  void
  ContactSolver::scale_by(const Vector &right_hand_side,
                          const Vector &candidate)
  {
    scales = scales_of_solutions;
    scales.include(problem, right_hand_side, candidate);
  }



  bool
  ContactSolver::accepts(const Certificate &certificate) const
  {
    const double forces = force_accuracy(), lengths = displacement_accuracy();
    return std::isfinite(certificate.worst()) &&
           std::max(forces, lengths) <= coarsest &&
           certificate.penetration <= lengths &&
           certificate.tension <= forces && certificate.residual <= forces &&
           std::max(certificate.complementarity, certificate.friction) <=
             std::max(forces, lengths);
  }



  void
  ContactSolver::solve_linear(LinearSolver &linear_solver,
                              const Vector &right_hand_side,
                              Vector       &solution)
  {
    if (!linear_solver.is_direct())
      {
        // The scales need the size of the solution: first solve roughly.
        constexpr double rough = 1e-2;
        scale_by(right_hand_side, solution);
        linear_solver.solve(solution,
                            right_hand_side,
                            std::max(residual_target(),
                                     rough * right_hand_side.l2_norm()));
        scale_by(right_hand_side, solution);
      }
    linear_solver.solve(solution, right_hand_side, residual_target());
  }



  std::vector<bool>
  ContactSolver::closed_bounds() const
  {
    const double      rounding = force_accuracy() * scales.force();
    std::vector<bool> closed(forces.normal.size());
    for (std::size_t k = 0; k < closed.size(); ++k)
      closed[k] = forces.normal[k] > rounding;
    return closed;
  }



  void
  ContactSolver::serialize(StateArchive &archive)
  {
    archive.common(scales);
    archive.common(scales_of_solutions);
    archive.on_bounds(forces.normal);
    std::vector<bool> set = first_set();
    archive.on_bounds(set);
    // Ranks without bounds take part in start_from().
    if (archive.is_loading() &&
        dealii::Utilities::MPI::logical_or(!set.empty(),
                                           archive.communicator()))
      start_from(set);
    serialize_states(archive);
    // Another method may resume: always write a factor, maybe empty.
    const dealii::LAPACKFullMatrix<double> nothing;
    PrincipalFactor                        none(nothing);
    PrincipalFactor *const                 factor = lip_factor();
    (factor != nullptr ? *factor : none).serialize(archive);
  }



  std::size_t
  ContactSolver::memory_consumption() const
  {
    return scaled_right_hand_side.memory_consumption() +
           residual.memory_consumption() +
           forces.normal.size() * sizeof(double);
  }



  void
  ContactSolver::complementarity_functions(
    const Vector              &solution,
    const std::vector<double> &contact_forces,
    const double               stiffness_factor,
    std::vector<double>       &values) const
  {
    const UnilateralBounds &bounds   = problem.bounds;
    const Vector           &diagonal = problem.diagonal();
    values.resize(bounds.dofs.size());
    for (std::size_t k = 0; k < values.size(); ++k)
      {
        const auto dof = bounds.dofs[k];
        values[k]      = bounds.sign[k] * solution(dof) - bounds.gap[k] -
                    contact_forces[k] / (stiffness_factor * diagonal(dof));
      }
  }



  void
  ContactSolver::stick_functions(const Vector        &solution,
                                 const ContactForces &contact_forces,
                                 const double         stiffness_factor,
                                 const FrictionState &state,
                                 std::vector<double> &values) const
  {
    const auto  &tangents = problem.bounds.tangents;
    const double least    = force_accuracy() * scales.force();
    values.assign(problem.bounds.dofs.size(), 0.);
    for (std::size_t k = 0; k < values.size(); ++k)
      if (const double g = contact_forces.normal[k] / stiffness_factor;
          g > least)
        {
          double kappa = 0.; // in space that of either tangent will do
          dealii::Tensor<1, 2> force, slip;
          for (std::size_t c = 0; c < tangents.size(); ++c)
            if (const auto i = tangents[c][k];
                i != dealii::numbers::invalid_dof_index)
              {
                kappa    = 1. / problem.diagonal()(i);
                force[c] = contact_forces.tangential[c][k] / stiffness_factor;
                slip[c]  = solution(i) - state.reference[c][k];
              }
          values[k] =
            kappa * state.coefficients[k] * g - (kappa * force - slip).norm();
        }
  }
} // namespace Crevasse
