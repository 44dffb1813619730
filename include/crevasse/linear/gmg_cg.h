// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_linear_gmg_cg_h
#define crevasse_linear_gmg_cg_h

#include <crevasse/linear/conjugate_gradients.h>
#include <crevasse/linear/direct_solver.h>
#include <crevasse/linear/multigrid_levels.h>
#include <crevasse/linear/principal_factor.h>
#include <crevasse/linear/stiffness_operator.h>

#include <deal.II/lac/precondition.h>

namespace Crevasse
{
  /**
   * Conjugate gradients preconditioned by geometric multigrid: one V-cycle with
   * Chebyshev smoothing, in single precision, on any number of ranks. Only the
   * coarsest level has a matrix. Held unknowns are held on every level that has
   * their nodes (after Kornhuber's truncated multigrid, Numer. Math. 69, 1994,
   * but without Galerkin's product), so that a closed lip costs no more
   * iterations than an open one.
   */
  template <int dim>
  class GmgCg : public ConjugateGradients
  {
  public:
    /** Sets up the hierarchy for a stiffness. Collective.
     *
     * @param finest A, on the space of the finest level.
     * @param stiffness K of A at the points of the finest level; not kept.
     * @param may_be_held All locally owned unknowns that hold() may get. All
     * but @p stiffness must outlive this object. */
    GmgCg(std::shared_ptr<const MultigridLevels<dim>>         levels,
          const StiffnessOperator<dim>                       &finest,
          const PointValues<VoigtMatrix<dim>>                &stiffness,
          const std::vector<dealii::types::global_dof_index> &may_be_held = {});

    void
    precondition(Vector &solution, const Vector &right_hand_side) override;

    void
    hold(const std::vector<dealii::types::global_dof_index> &dofs) override;

    /** Bytes on this rank, without the levels, which stiffnesses may share. */
    std::size_t
    memory_consumption() const override;

    std::string
    preconditioner_description() const override;

    /** Levels, also for other stiffnesses of the same space. */
    const std::shared_ptr<const MultigridLevels<dim>> levels;

  protected:
    void
    multiply(Vector &result, const Vector &v) const override
    {
      finest.vmult(result, v);
    }

  private:
    using Operator = StiffnessProduct<dim, LevelReal>;

    struct Level
    {
      std::unique_ptr<Operator> A; ///< A, or null on level 0
      /** Chebyshev smoother (Adams et al., J. Comput. Phys. 188, 2003). */
      dealii::PreconditionChebyshev<Operator, LevelVector> smoother;
      std::vector<unsigned int> held; ///< held unknowns, local indices
      LevelVector               defect, solution, residual;
    };

    void
    set_up_smoother(Level &level);

    /** Unknowns of each level at the nodes of these unknowns of the finest
     * level, as local indices. */
    std::vector<std::vector<unsigned int>>
    on_levels(const std::vector<dealii::types::global_dof_index> &dofs) const;

    /** Unknowns on all ranks from local indices of the coarsest level. */
    DirectSolver::Indices
    coarsest_dofs(const std::vector<unsigned int> &rows) const;

    void
    set_up_coarsest(
      const std::vector<dealii::types::global_dof_index> &may_be_held);

    /** Solves on the coarsest level. Held unknowns stay zero. */
    void
    solve_coarsest(Vector &solution, const Vector &defect);

    /** Applies one V-cycle to the defect of a level. Held unknowns stay zero.
     */
    void
    cycle(const unsigned int level);

    const StiffnessOperator<dim> &finest;
    double                        unit; ///< unit of A on the levels
    Matrix                        coarsest_matrix;
    std::unique_ptr<LinearSolver> coarsest_solver;
    /** The direct coarsest solver, or null, and its factor of free unknowns. */
    DirectSolver                    *coarsest_factor = nullptr;
    std::unique_ptr<PrincipalFactor> not_held;
    Vector             coarsest_defect, coarsest_solution; ///< double precision
    std::vector<Level> levels_of_cycle;
    std::vector<dealii::types::global_dof_index> held_dofs;
  };
} // namespace Crevasse

#endif
