// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/contact/active_set.h>
#include <crevasse/contact/condensed_solver.h>
#include <crevasse/contact/no_contact.h>
#include <crevasse/contact/projected_sor.h>
#include <crevasse/linear/gmg_cg.h>
#include <crevasse/linear/matrix_operator.h>
#include <crevasse/linear/operator_check.h>
#include <crevasse/model/contact_system.h>

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
    const bool matrix_free =
      settings.linear_choice.type == LinearSolverType::gmg;
    std::optional<Stopwatch> phase(std::in_place,
                                   matrix_free ? "multigrid set-up"
                                               : "assembly");
    if (matrix_free)
      {
        if (levels == nullptr)
          levels = std::make_shared<const MultigridLevels<dim>>(space, points);
        auto A =
          std::make_unique<StiffnessOperator<dim>>(space, points, stiffness);
        require_same_product(*A, space, points, stiffness);
        open_solver =
          std::make_unique<GmgCg<dim>>(levels, *A, stiffness, bounds.dofs);
        linear_operator = std::move(A);
        // By now the products have created the shared data of the levels.
        if (similar == nullptr)
          bytes_of_levels = levels->memory_consumption();
        ++setups.multigrid_setups;
      }
    else
      {
        if (similar != nullptr)
          matrix.reinit(similar->matrix);
        assemble_stiffness(space, points, stiffness, matrix);
        linear_operator = std::make_unique<MatrixOperator>(matrix);
        ++setups.assemblies;
      }
    phase.reset();
    signorini_problem =
      std::make_unique<SignoriniProblem>(*linear_operator, bounds);
    contact = make_contact_solver();
    contact->set_force_scale(settings.largest_load);
  }



  template <int dim>
  std::unique_ptr<ContactSolver>
  ContactSystem<dim>::make_contact_solver()
  {
    const ContactParameters &parameters = settings.contact;
    const SignoriniProblem  &problem    = *signorini_problem;
    if (problem.n_bounds() == 0)
      return std::make_unique<NoContact>(problem,
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
          return std::make_unique<CondensedSolver>(
            problem,
            dynamic_cast<DirectSolver &>(linear_solver()), // see choose_contact
            parameters.tolerance);
        case ContactSolverType::automatic:
          break; // replaced by a choice before
      }
    AssertThrow(false, ExcInternalError());
    return nullptr;
  }



  template <int dim>
  LinearSolver &
  ContactSystem<dim>::linear_solver()
  {
    if (open_solver == nullptr)
      {
        const LinearSolverType type  = settings.linear_choice.type;
        const bool      is_multigrid = traits(type).has(Trait::is_multigrid);
        const Stopwatch phase(is_multigrid ? "multigrid set-up"
                                           : "factorisation");
        ++(is_multigrid ? setups.multigrid_setups : setups.factorisations);
        const bool condenses = settings.contact_choice.type ==
                               ContactSolverType::condensed_active_set;
        SparseMatrix with_springs;
        if (!signorini_problem->bounds.free_motions.empty())
          {
            with_springs.copy_from(matrix);
            const auto springs = signorini_problem->springs();
            const std::vector<types::global_dof_index> &dofs =
              signorini_problem->bounds.dofs;
            for (unsigned int k = 0; k < dofs.size(); ++k)
              with_springs.add(dofs[k], dofs[k], springs[k]);
            with_springs.compress(VectorOperation::add);
          }
        open_solver =
          make_matrix_solver(type,
                             space,
                             with_springs.m() > 0 ? with_springs : matrix,
                             condenses ? signorini_problem->all_lip_dofs()
                                       : DirectSolver::Indices(),
                             analysis);
      }
    return *open_solver;
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
    all.add(contact->statistics());
    if (open_solver != nullptr)
      {
        all.linear_solves += open_solver->n_solves();
        all.linear_iterations += open_solver->n_iterations();
      }
    return all;
  }



  template class ContactSystem<2>;
  template class ContactSystem<3>;
} // namespace Crevasse
