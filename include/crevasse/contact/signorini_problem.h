// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_contact_signorini_problem_h
#define crevasse_contact_signorini_problem_h

#include <crevasse/linear/linear_operator.h>

#include <memory>
#include <string>

namespace Crevasse
{
  using SparseMatrix = dealii::TrilinosWrappers::SparseMatrix;

  /**
   * The one-sided bounds of the locally owned contact dofs: `sign[k] *
   * q[dofs[k]] >= gap[k]`. The sign (±1) turns a dof into the displacement
   * along the inward normal of the lip.
   */
  struct UnilateralBounds
  {
    /** A motion without energy, by what it adds to each `sign * q[dof]`. */
    struct FreeMotion
    {
      std::string         name;
      std::vector<double> openings;
    };

    std::vector<dealii::types::global_dof_index> dofs;
    std::vector<double>                          sign;
    std::vector<double>                          gap;

    /** The last ones that are of no place on the lip: their unknowns couple
     * with all others. */
    unsigned int n_global = 0;

    /** A basis of the kernel of A: what bounds alone can stop. The same motions
     * on all ranks, each of which opens some bound. */
    std::vector<FreeMotion> free_motions;
  };

  /**
   * The discrete variational inequality: minimise ½ qᵀAq − bᵀq under the
   * bounds; in other words (paper, §6; model, §3)
   *
   *     A q − b = Lᵀ g,      0 ≤ g ⟂ L q − gap ≥ 0.
   *
   * A is symmetric positive definite, but for free motions. Nothing here knows
   * of finite elements, time or materials. The right-hand side comes with each
   * solve.
   */
  class SignoriniProblem
  {
  public:
    /** Both must outlive the problem. @throw NumericalError if a diagonal
     * entry is not positive: then A is not positive definite. */
    SignoriniProblem(const LinearOperator   &stiffness,
                     const UnilateralBounds &bounds);
    SignoriniProblem(const SparseMatrix     &matrix,
                     const UnilateralBounds &bounds);

  private:
    SignoriniProblem(std::shared_ptr<const LinearOperator> own,
                     const UnilateralBounds               &bounds);

    std::shared_ptr<const LinearOperator> of_matrix; ///< null: not its own

  public:
    const LinearOperator &stiffness; ///< A

    const UnilateralBounds &bounds;

    /** A as a matrix, for what needs its entries: a scene that does has no
     * matrix-free operator. */
    const SparseMatrix &
    matrix() const
    {
      return *stiffness.matrix();
    }

    /** The diagonal of A: the scale of forces, and the SOR sweep's divisor. */
    const Vector &
    diagonal() const
    {
      return stiffness.diagonal();
    }

    /** Springs at the locally owned bounds with which A is positive definite
     * although there are free motions. A solution without springs is the limit
     * of those whose springs are at rest where the one before was. */
    std::vector<double>
    springs() const;

    /** Number of bounds on all ranks. */
    dealii::types::global_dof_index
    n_bounds() const
    {
      return all_dofs.size();
    }

    /** The unknowns of all ranks that have bounds, rank by rank. */
    const LinearOperator::Indices &
    all_bounded_dofs() const
    {
      return all_dofs;
    }

  private:
    LinearOperator::Indices all_dofs;
  };
} // namespace Crevasse

#endif
