// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/contact/active_set.h>
#include <crevasse/contact/condensed_active_set.h>
#include <crevasse/contact/projected_sor.h>
#include <crevasse/contact/unconstrained.h>
#include <crevasse/discretisation/rigid_modes.h>
#include <crevasse/linear/amg_cg.h>
#include <crevasse/linear/gmg_cg.h>
#include <crevasse/linear/matrix_operator.h>
#include <crevasse/linear/mumps.h>
#include <crevasse/linear/operator_check.h>
#include <crevasse/model/contact_system.h>

#include <utility>

namespace Crevasse
{
  using namespace dealii;

  template <int dim>
  ContactSystem<dim>::ContactSystem(
    const SolverSettings                &settings,
    const Space<dim>                    &space,
    const QuadratureField<dim>          &points,
    const PointValues<VoigtMatrix<dim>> &stiffness,
    const UnilateralBounds              &bounds,
    const ContactSystem                 *similar)
    : settings(settings)
    , space(space)
    , analysis(similar != nullptr ? similar->analysis : nullptr)
    , levels(similar != nullptr ? similar->levels : nullptr)
  {
    if (settings.linear_choice.type == LinearSolverType::gmg)
      set_up_multigrid(points, stiffness);
    else
      assemble(points, stiffness, similar);
    signorini_problem =
      std::make_unique<SignoriniProblem>(*linear_operator, bounds);
    contact = make_contact_solver();
    contact->set_force_scale(settings.largest_load);
  }



  template <int dim>
  void
  ContactSystem<dim>::assemble(const QuadratureField<dim>          &points,
                               const PointValues<VoigtMatrix<dim>> &stiffness,
                               const ContactSystem                 *similar)
  {
    TimerOutput::Scope phase(settings.phases, "assembly");
    if (similar != nullptr)
      matrix.reinit(similar->matrix);
    assemble_stiffness(space, points, stiffness, matrix);
    linear_operator = std::make_unique<MatrixOperator>(matrix);
    ++setups.assemblies;
  }



  template <int dim>
  void
  ContactSystem<dim>::set_up_multigrid(
    const QuadratureField<dim>          &points,
    const PointValues<VoigtMatrix<dim>> &stiffness)
  {
    TimerOutput::Scope phase(settings.phases, "multigrid set-up");
    if (levels == nullptr)
      {
        levels = std::make_shared<const MultigridLevels<dim>>(space, points);
        bytes_of_levels = levels->memory_consumption();
      }
    auto matrix_free =
      std::make_unique<StiffnessOperator<dim>>(space, points, stiffness);
    require_same_product(*matrix_free, space, points, stiffness);
    open_solver = std::make_unique<GmgCg<dim>>(levels, *matrix_free, stiffness);
    linear_operator = std::move(matrix_free);
    ++setups.multigrid_setups;
  }



  template <int dim>
  std::unique_ptr<ContactSolver>
  ContactSystem<dim>::make_contact_solver()
  {
    const ContactParameters &parameters = settings.contact;
    const SignoriniProblem  &problem    = *signorini_problem;
    if (problem.n_bounds() == 0)
      return std::make_unique<Unconstrained>(problem,
                                             linear_solver(),
                                             parameters.tolerance);
    switch (settings.contact_choice.type)
      {
        case ContactSolverType::projected_sor:
          return std::make_unique<ProjectedSor>(problem,
                                                settings.relaxation_factor(
                                                  matrix),
                                                parameters.tolerance,
                                                parameters.maximum_iterations);
        case ContactSolverType::active_set:
          return std::make_unique<ActiveSet>(problem,
                                             linear_solver(),
                                             parameters.tolerance,
                                             settings.linear_solver.tolerance,
                                             parameters.maximum_iterations);
        case ContactSolverType::condensed_active_set:
          return std::make_unique<CondensedActiveSet>(problem,
                                                      linear_solver(),
                                                      parameters.tolerance);
        case ContactSolverType::automatic:
          break; // chosen before
      }
    AssertThrow(false, ExcInternalError());
    return nullptr;
  }



  template <int dim>
  std::unique_ptr<LinearSolver>
  ContactSystem<dim>::make_linear_solver()
  {
    if (settings.linear_choice.type == LinearSolverType::amg)
      {
        TimerOutput::Scope phase(settings.phases, "multigrid set-up");
        ++setups.multigrid_setups;
        return std::make_unique<AmgCg>(matrix,
                                       rigid_modes(space),
                                       dim,
                                       space.finite_element().degree > 1);
      }
    TimerOutput::Scope phase(settings.phases, "factorisation");
    ++setups.factorisations;
    if (settings.linear_choice.type == LinearSolverType::mumps)
      return std::make_unique<Mumps>(matrix);
    auto cholesky = std::make_unique<Cholesky>(matrix, analysis);
    analysis      = cholesky->analysis();
    return cholesky;
  }



  template <int dim>
  LinearSolver &
  ContactSystem<dim>::linear_solver()
  {
    if (open_solver == nullptr)
      open_solver = make_linear_solver();
    return *open_solver;
  }



  template <int dim>
  const LinearOperator &
  ContactSystem<dim>::stiffness() const
  {
    return *linear_operator;
  }



  template <int dim>
  const SignoriniProblem &
  ContactSystem<dim>::problem() const
  {
    return *signorini_problem;
  }



  template <int dim>
  ContactSolver &
  ContactSystem<dim>::contact_solver()
  {
    return *contact;
  }



  template <int dim>
  void
  ContactSystem<dim>::describe(Summary &summary) const
  {
    const bool                 has_bounds = signorini_problem->n_bounds() > 0;
    const ContactSolverChoice &choice     = settings.contact_choice;
    summary["contact_solver"]             = {
                  {"name", has_bounds ? name_of(choice.type) : "none"},
                  {"why", has_bounds ? choice.why : "there is no contact"},
                  {"description", contact->description()}};
    if (open_solver != nullptr)
      summary["linear_solver"] = {{"why", settings.linear_choice.why},
                                  {"description", open_solver->description()}};
  }



  template <int dim>
  SolverStatistics
  ContactSystem<dim>::statistics() const
  {
    SolverStatistics all = setups;
    all.add(*contact);
    if (open_solver != nullptr)
      all.add(*open_solver);
    return all;
  }



  template <int dim>
  std::size_t
  ContactSystem<dim>::memory_consumption() const
  {
    return matrix.memory_consumption() + linear_operator->memory_consumption() +
           bytes_of_levels + contact->memory_consumption() +
           (open_solver != nullptr ? open_solver->memory_consumption() : 0);
  }



  template class ContactSystem<2>;
  template class ContactSystem<3>;
} // namespace Crevasse
