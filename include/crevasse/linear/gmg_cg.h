// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_linear_gmg_cg_h
#define crevasse_linear_gmg_cg_h

#include <crevasse/linear/conjugate_gradients.h>
#include <crevasse/linear/multigrid_levels.h>
#include <crevasse/linear/stiffness_operator.h>

#include <deal.II/multigrid/multigrid.h>

#include <memory>

namespace Crevasse
{
  /**
   * Conjugate gradients with geometric multigrid as preconditioner: one V-cycle
   * with Chebyshev smoothing. No matrix but that of the coarsest level, on any
   * number of ranks. Held unknowns are held on every level (truncated
   * multigrid: Kornhuber, Numer. Math. 69, 1994), so that contact costs no
   * iterations.
   */
  template <int dim>
  class GmgCg : public ConjugateGradients
  {
  public:
    /** Sets up what depends on the stiffness. Collective.
     *
     * @param finest A, on the space of the finest level.
     * @param stiffness K of A at the points of that level; not kept.
     * All but @p stiffness must outlive this object. */
    GmgCg(std::shared_ptr<const MultigridLevels<dim>> levels,
          StiffnessOperator<dim>                     &finest,
          const PointValues<VoigtMatrix<dim>>        &stiffness);
    ~GmgCg() override;

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
    std::shared_ptr<const MultigridLevels<dim>>
    levels() const
    {
      return shared_levels;
    }

  protected:
    void
    multiply(Vector &result, const Vector &v) const override;

  private:
    class Transfer;
    class CoarseSolver;
    class LevelMatrices;
    class LevelSmoothers;

    using Operator = StiffnessOperator<dim>;

    Operator &
    level_operator(const unsigned int level);

    const std::shared_ptr<const MultigridLevels<dim>> shared_levels;
    Operator                                         &finest;

    std::vector<std::unique_ptr<Operator>> coarser; ///< 0 is null: a matrix
    Matrix                                 coarsest_matrix;
    std::unique_ptr<LinearSolver>          coarsest_solver;

    std::unique_ptr<Transfer>                  transfer;
    std::unique_ptr<CoarseSolver>              coarse_solver;
    std::unique_ptr<LevelMatrices>             matrices;
    std::unique_ptr<LevelSmoothers>            smoothers;
    std::unique_ptr<dealii::Multigrid<Vector>> cycle;

    std::vector<dealii::types::global_dof_index> held_dofs;
    std::vector<unsigned int> held_on_finest; ///< the same, as local indices
    Vector                    layout;         ///< of the finest level
  };
} // namespace Crevasse

#endif
