// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

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
                    const PointValues<VoigtMatrix<dim>>        &stiffness)
    : shared_levels(std::move(levels))
    , finest(finest)
    , levels_of_cycle(shared_levels->n_levels())
  {
    const MultigridLevels<dim> &of       = *shared_levels;
    const auto                  values   = of.on_coarser_levels(stiffness);
    const unsigned int          n_levels = of.n_levels();
    assemble_stiffness(of.space(0),
                       of.points(0),
                       n_levels == 1 ? stiffness : values[0],
                       coarsest_matrix);
    // Exact, but for meshes that are large before anything is refined.
    std::shared_ptr<const Cholesky::Factor> no_analysis;
    coarsest_solver =
      make_matrix_solver(choose_matrix_solver(dim,
                                              of.space(0).n_unknowns(),
                                              Utilities::MPI::n_mpi_processes(
                                                of.space(0).communicator()))
                           .type,
                         of.space(0),
                         coarsest_matrix,
                         {},
                         no_analysis);
    for (Vector *vector : {&coarsest_defect, &coarsest_solution})
      of.space(0).cell_loops()->initialize(*vector);

    // Single precision ends at 1e±38: numbers near 1 do not depend on units.
    double largest = 0.;
    for (const VoigtMatrix<dim> &K : stiffness.distinct())
      largest = std::max(largest, K[0][0]);
    const double unit_of_K =
      Utilities::MPI::max(largest, finest.get_mpi_communicator());
    unit =
      unit_of_K * std::pow(of.space(0).cell_loops()->length_unit(), dim - 2);

    for (unsigned int l = 0; l < n_levels; ++l)
      {
        Level &level = levels_of_cycle[l];
        for (auto *vector : {&level.defect, &level.solution, &level.residual})
          of.space(l).cell_loops()->initialize(*vector);
        if (l == 0)
          continue;
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
  GmgCg<dim>::set_up_smoother(Level &level)
  {
    // Degree, range of eigenvalues and the iterations that estimate them. With
    // degree 4 there are a quarter fewer iterations, but each costs two thirds
    // more (doc/scaling.md).
    typename decltype(level.smoother)::AdditionalData settings(2, 10., 12);
    settings.preconditioner = std::make_shared<DiagonalMatrix<LevelVector>>();
    LevelVector &inverse    = settings.preconditioner->get_vector();
    inverse                 = level.A->diagonal();
    for (LevelReal &entry : inverse)
      entry = 1 / entry;
    level.smoother.initialize(*level.A, settings);
    // Now, not when the first vector comes.
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

    // A node of a coarser level is held if it is, as node of the finest one.
    std::vector<unsigned int> rows;
    const auto &layout = *levels_of_cycle.back().defect.get_partitioner();
    for (const auto dof : held_dofs)
      rows.push_back(layout.global_to_local(dof));
    std::sort(rows.begin(), rows.end());
    for (unsigned int level = shared_levels->n_levels(); level-- > 0;)
      {
        levels_of_cycle[level].held = rows;
        if (level == 0)
          break;
        levels_of_cycle[level].A->hold(rows);
        rows = shared_levels->transfer(level).at_same_nodes(rows);
      }
  }



  template <int dim>
  void
  GmgCg<dim>::solve_coarsest(Vector &solution, const Vector &defect)
  {
    solution = 0.;
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
    const LevelTransfer<dim> &transfer = shared_levels->transfer(l);
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
    // Of Chebyshev's iteration, with the inverse of the diagonal.
    constexpr unsigned int n_smoother_vectors = 4;
    std::size_t            bytes = coarsest_matrix.memory_consumption() +
                        coarsest_solver->memory_consumption();
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
    const unsigned int n = shared_levels->n_levels();
    return "matrix-free geometric multigrid of " + std::to_string(n) +
           (n == 1 ? " level (a mesh without coarser ones: all is " +
                       coarsest_solver->description() + ")"
                   : " levels");
  }



  template class GmgCg<2>;
  template class GmgCg<3>;
} // namespace Crevasse
