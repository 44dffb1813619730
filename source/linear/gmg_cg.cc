// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/discretisation/stiffness.h>
#include <crevasse/linear/gmg_cg.h>
#include <crevasse/linear/solver_choice.h>

#include <deal.II/base/mpi.h>
#include <deal.II/lac/diagonal_matrix.h>

#include <algorithm>

namespace Crevasse
{
  using namespace dealii;

  template <int dim>
  GmgCg<dim>::GmgCg(std::shared_ptr<const MultigridLevels<dim>> levels,
                    StiffnessOperator<dim>                     &finest,
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
    for (unsigned int l = 0; l < n_levels; ++l)
      {
        Level &level = levels_of_cycle[l];
        for (Vector *vector : {&level.defect, &level.solution, &level.residual})
          of.space(l).matrix_free()->initialize_dof_vector(*vector);
        if (l == 0)
          continue;
        level.A = &finest;
        if (l + 1 < n_levels)
          {
            level.own =
              std::make_unique<Operator>(of.space(l), of.points(l), values[l]);
            level.A = level.own.get();
            level.A->hold(&level.held);
          }
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
    settings.preconditioner = std::make_shared<DiagonalMatrix<Vector>>();
    Vector &inverse         = settings.preconditioner->get_vector();
    inverse                 = level.A->diagonal();
    for (double &entry : inverse)
      entry = 1. / entry;
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
        if (level > 0)
          rows = shared_levels->transfer(level).at_same_nodes(rows);
      }
  }



  template <int dim>
  void
  GmgCg<dim>::cycle(const unsigned int l)
  {
    Level     &level         = levels_of_cycle[l];
    const auto set_held_zero = [](const Level &of, Vector &vector) {
      for (const unsigned int row : of.held)
        vector.local_element(row) = 0.;
    };
    if (l == 0)
      {
        level.solution = 0.;
        coarsest_solver->precondition(level.solution, level.defect);
        set_held_zero(level, level.solution);
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
    Level &level = levels_of_cycle.back();
    level.defect.copy_locally_owned_data_from(right_hand_side);
    // Not for those who need all of A, whether an exception ends this or not.
    const auto release = [](Operator *A) { A->hold(nullptr); };
    const std::unique_ptr<Operator, decltype(release)> holding(&finest,
                                                               release);
    finest.hold(&level.held);
    cycle(levels_of_cycle.size() - 1);
    solution.copy_locally_owned_data_from(level.solution);
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
               (level.own != nullptr ? level.own->memory_consumption() : 0);
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
