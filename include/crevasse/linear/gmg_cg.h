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
   * Conjugate gradients with geometric multigrid as preconditioner: one V-cycle
   * with Chebyshev smoothing, in single precision. No matrix but that of the
   * coarsest level, on any number of ranks. Held unknowns are held on every
   * level that has their nodes (after Kornhuber's truncated multigrid, Numer.
   * Math. 69, 1994, but without Galerkin's product), so that a closed lip costs
   * no more iterations than an open one.
   */
  template <int dim>
  class GmgCg : public ConjugateGradients
  {
  public:
    /** Sets up what depends on the stiffness. Collective.
     *
     * @param finest A, on the space of the finest level.
     * @param stiffness K of A at the points of that level; not kept.
     * @param may_be_held all locally owned unknowns that hold() may get.
     * All but @p stiffness must outlive this object. */
    GmgCg(std::shared_ptr<const MultigridLevels<dim>>         levels,
          const StiffnessOperator<dim>                       &finest,
          const PointValues<VoigtMatrix<dim>>                &stiffness,
          const std::vector<dealii::types::global_dof_index> &may_be_held = {});

    void
    precondition(Vector &solution, const Vector &right_hand_side) override;

    void
    hold(const std::vector<dealii::types::global_dof_index> &dofs) override;

    /** Without the levels, which other stiffnesses of the space may share. */
    std::size_t
    memory_consumption() const override;

    std::string
    preconditioner_description() const override;

    /** For other stiffnesses of the same space. */
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
      std::unique_ptr<Operator> A; ///< of level 0 a matrix
      /** Chebyshev polynomials (Adams et al., J. Comput. Phys. 188, 2003). */
      dealii::PreconditionChebyshev<Operator, LevelVector> smoother;
      std::vector<unsigned int> held; ///< local indices
      LevelVector               defect, solution, residual;
    };

    void
    set_up_smoother(Level &level);

    /** Those of a level that are at the nodes of these unknowns of the finest
     * one, for all levels; local indices. */
    std::vector<std::vector<unsigned int>>
    on_levels(const std::vector<dealii::types::global_dof_index> &dofs) const;

    /** Of all ranks, from local indices of the coarsest level. */
    DirectSolver::Indices
    coarsest_dofs(const std::vector<unsigned int> &rows) const;

    void
    set_up_coarsest(
      const std::vector<dealii::types::global_dof_index> &may_be_held);

    /** Solves on the coarsest level. Held unknowns are zero. */
    void
    solve_coarsest(Vector &solution, const Vector &defect);

    /** One V-cycle for the solution of a level from its defect. Held unknowns
     * stay zero. */
    void
    cycle(const unsigned int level);

    const StiffnessOperator<dim> &finest;
    double                        unit; ///< that the levels have for A
    Matrix                        coarsest_matrix;
    std::unique_ptr<LinearSolver> coarsest_solver;
    /** The same if it is one, and the factor for those that are not held. */
    DirectSolver                    *coarsest_factor = nullptr;
    std::unique_ptr<PrincipalFactor> not_held;
    Vector coarsest_defect, coarsest_solution; ///< in double precision
    std::vector<Level>                           levels_of_cycle;
    std::vector<dealii::types::global_dof_index> held_dofs;
  };
} // namespace Crevasse

#endif
