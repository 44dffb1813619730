// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/collectively.h>
#include <crevasse/discretisation/stiffness.h>
#include <crevasse/linear/gmg_cg.h>
#include <crevasse/linear/solver_choice.h>

#include <deal.II/lac/diagonal_matrix.h>

#include <algorithm>

namespace Crevasse
{
  using namespace dealii;

  template <int dim>
  GmgCg<dim>::GmgCg(std::shared_ptr<const MultigridLevels<dim>> levels,
                    const StiffnessOperator<dim>               &finest,
                    const PointValues<VoigtMatrix<dim>>        &stiffness,
                    const std::vector<types::global_dof_index> &may_be_held)
    : levels(std::move(levels))
    , finest(finest)
    , levels_of_cycle(this->levels->n_levels())
  {
    const MultigridLevels<dim> &of       = *this->levels;
    const auto                  values   = of.on_coarser_levels(stiffness);
    const unsigned int          n_levels = of.n_levels();
    for (unsigned int l = 0; l < n_levels; ++l)
      for (LevelVector *vector : {&levels_of_cycle[l].defect,
                                  &levels_of_cycle[l].solution,
                                  &levels_of_cycle[l].residual})
        of.space(l).cell_loops()->initialize(*vector);
    assemble_stiffness(of.space(0),
                       of.points(0),
                       n_levels == 1 ? stiffness : values[0],
                       coarsest_matrix);
    set_up_coarsest(may_be_held);
    for (Vector *vector : {&coarsest_defect, &coarsest_solution})
      of.space(0).cell_loops()->initialize(*vector);

    // Single precision ends at 1e±38: scaled units keep numbers near 1.
    double largest = 0.;
    for (const VoigtMatrix<dim> &K : stiffness.distinct())
      largest = std::max(largest, K[0][0]);
    const double unit_of_K =
      Utilities::MPI::max(largest, finest.get_mpi_communicator());
    unit = unit_of_K * std::pow(of.space(0).cell_loops()->length_unit(),
                                of.space(0).measure_dimension() - 2.);

    for (unsigned int l = 1; l < n_levels; ++l)
      {
        Level &level = levels_of_cycle[l];
        level.A =
          std::make_unique<Operator>(of.space(l),
                                     of.points(l),
                                     l + 1 < n_levels ? values[l] : stiffness,
                                     unit_of_K);
        set_up_smoother(level);
      }
  }



  template <int dim>
  void
  GmgCg<dim>::set_up_coarsest(
    const std::vector<types::global_dof_index> &may_be_held)
  {
    const Space<dim> &space = levels->space(0);
    // The lip of a fine coarsest mesh is too large for dense matrices; then the
    // solver for all unknowns is used, and held unknowns are set to 0.
    constexpr std::size_t largest_lip = 2000;
    auto                  lip = coarsest_dofs(on_levels(may_be_held)[0]);
    if (lip.size() > largest_lip)
      lip.clear();
    // The coarsest solver is exact unless even the unrefined mesh is large.
    std::shared_ptr<const Cholesky::Factor> no_analysis;
    coarsest_solver =
      make_matrix_solver(choose_matrix_solver(dim,
                                              space.n_unknowns(),
                                              Utilities::MPI::n_mpi_processes(
                                                space.communicator()))
                           .type,
                         space,
                         coarsest_matrix,
                         lip,
                         no_analysis);
    if (!lip.empty())
      coarsest_factor = dynamic_cast<DirectSolver *>(coarsest_solver.get());
    if (coarsest_factor == nullptr)
      return;
    not_held =
      std::make_unique<PrincipalFactor>(coarsest_factor->lip_stiffness());
    not_held->choose(std::vector<bool>(lip.size(), true));
  }



  template <int dim>
  DirectSolver::Indices
  GmgCg<dim>::coarsest_dofs(const std::vector<unsigned int> &rows) const
  {
    const auto           &layout = *levels_of_cycle[0].defect.get_partitioner();
    DirectSolver::Indices local;
    for (const unsigned int row : rows)
      local.push_back(layout.local_to_global(row));
    return of_all_ranks(finest.get_mpi_communicator(), local);
  }



  template <int dim>
  void
  GmgCg<dim>::set_up_smoother(Level &level)
  {
    // Smoother: degree, range of eigenvalues, iterations to estimate them.
    // Degree 4 needs a quarter fewer iterations, but each costs two thirds more
    // (doc/scaling.md).
    typename decltype(level.smoother)::AdditionalData settings(2, 10., 12);
    settings.preconditioner = std::make_shared<DiagonalMatrix<LevelVector>>();
    LevelVector &inverse    = settings.preconditioner->get_vector();
    inverse                 = level.A->diagonal();
    for (LevelReal &entry : inverse)
      entry = 1 / entry;
    level.smoother.initialize(*level.A, settings);
    // Estimate now, not when the smoother is first applied.
    level.smoother.estimate_eigenvalues(inverse);
  }



  template <int dim>
  void
  GmgCg<dim>::hold(const std::vector<types::global_dof_index> &dofs)
  {
    if (Utilities::MPI::max(dofs != held_dofs ? 1 : 0,
                            finest.get_mpi_communicator()) == 0)
      return;
    held_dofs = dofs;

    const auto rows = on_levels(held_dofs);
    for (unsigned int l = 0; l < rows.size(); ++l)
      {
        levels_of_cycle[l].held = rows[l];
        if (l > 0)
          levels_of_cycle[l].A->hold(rows[l]);
      }
    if (coarsest_factor == nullptr)
      return;
    const DirectSolver::Indices &lip = coarsest_factor->lip;
    std::vector<bool>            set(lip.size(), true);
    for (const auto dof : coarsest_dofs(rows[0]))
      {
        const auto place = std::lower_bound(lip.begin(), lip.end(), dof);
        Assert(place != lip.end() && *place == dof,
               ExcMessage("This unknown was not to be held."));
        set[place - lip.begin()] = false;
      }
    // Factorise from scratch: an update would round differently after a resume.
    not_held->choose(std::vector<bool>(lip.size(), false));
    not_held->choose(set);
  }



  template <int dim>
  std::vector<std::vector<unsigned int>>
  GmgCg<dim>::on_levels(const std::vector<types::global_dof_index> &dofs) const
  {
    const unsigned int finest_level = levels->n_levels() - 1;
    std::vector<std::vector<unsigned int>> rows(finest_level + 1);
    const auto &layout = *levels_of_cycle.back().defect.get_partitioner();
    for (const auto dof : dofs)
      rows.back().push_back(layout.global_to_local(dof));
    std::sort(rows.back().begin(), rows.back().end());
    for (unsigned int level = finest_level; level > 0; --level)
      rows[level - 1] = levels->transfer(level).at_same_nodes(rows[level]);
    return rows;
  }



  template <int dim>
  void
  GmgCg<dim>::solve_coarsest(Vector &solution, const Vector &defect)
  {
    solution = 0.;
    if (coarsest_factor != nullptr)
      {
        coarsest_factor->solve_with_lip(
          solution, defect, [this](DirectSolver::LipVector &on_lip) {
            not_held->solve(on_lip);
          });
        return;
      }
    coarsest_solver->precondition(solution, defect);
    for (const unsigned int row : levels_of_cycle[0].held)
      solution.local_element(row) = 0.;
  }



  template <int dim>
  void
  GmgCg<dim>::cycle(const unsigned int l)
  {
    Level     &level         = levels_of_cycle[l];
    const auto set_held_zero = [](const Level &of, LevelVector &vector) {
      for (const unsigned int row : of.held)
        vector.local_element(row) = 0.;
    };
    if (l == 0)
      {
        coarsest_defect.copy_locally_owned_data_from(level.defect);
        solve_coarsest(coarsest_solution, coarsest_defect);
        coarsest_solution *= unit;
        level.solution.copy_locally_owned_data_from(coarsest_solution);
        return;
      }
    const LevelTransfer<dim> &transfer = levels->transfer(l);
    Level                    &coarser  = levels_of_cycle[l - 1];
    level.smoother.vmult(level.solution, level.defect);
    level.A->vmult(level.residual, level.solution);
    level.residual.sadd(-1., 1., level.defect);
    coarser.defect = 0.;
    transfer.restrict_and_add(coarser.defect, level.residual);
    set_held_zero(coarser, coarser.defect);
    cycle(l - 1);
    transfer.prolongate_and_add(level.solution, coarser.solution);
    set_held_zero(level, level.solution);
    level.smoother.step(level.solution, level.defect);
  }



  template <int dim>
  void
  GmgCg<dim>::precondition(Vector &solution, const Vector &right_hand_side)
  {
    if (levels_of_cycle.size() == 1)
      {
        solve_coarsest(solution, right_hand_side);
        return;
      }
    const double size = right_hand_side.linfty_norm();
    if (size == 0.)
      {
        solution = 0.;
        return;
      }
    Level &level = levels_of_cycle.back();
    for (std::size_t i = 0; i < level.defect.locally_owned_size(); ++i)
      level.defect.local_element(i) = right_hand_side.local_element(i) / size;
    cycle(levels_of_cycle.size() - 1);
    for (std::size_t i = 0; i < level.solution.locally_owned_size(); ++i)
      solution.local_element(i) = size / unit * level.solution.local_element(i);
  }



  template <int dim>
  std::size_t
  GmgCg<dim>::memory_consumption() const
  {
    // Vectors of the Chebyshev iteration and the inverse diagonal.
    constexpr unsigned int n_smoother_vectors = 4;
    std::size_t            bytes = coarsest_matrix.memory_consumption() +
                        coarsest_solver->memory_consumption();
    if (not_held != nullptr)
      bytes += not_held->memory_consumption();
    for (const Level &level : levels_of_cycle)
      bytes += (3 + (level.A != nullptr ? n_smoother_vectors : 0)) *
                 level.defect.memory_consumption() +
               (level.A != nullptr ? level.A->memory_consumption() : 0);
    return bytes;
  }



  template <int dim>
  std::string
  GmgCg<dim>::preconditioner_description() const
  {
    const unsigned int n = levels->n_levels();
    return "matrix-free geometric multigrid of " + std::to_string(n) +
           (n == 1 ? " level (the mesh has no coarser one; solved by " +
                       coarsest_solver->description() + ")"
                   : " levels");
  }



  template class GmgCg<2>;
  template class GmgCg<3>;
} // namespace Crevasse
