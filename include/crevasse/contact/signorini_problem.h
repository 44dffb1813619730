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
   * One-sided bounds of the locally owned contact dofs: `sign[k] * q[dofs[k]]
   * >= gap[k]`. The sign (±1) turns a dof into the displacement along the
   * inward normal of the lip.
   */
  struct UnilateralBounds
  {
    /** A motion without energy, given by its `sign * q[dof]` at each bound. */
    struct FreeMotion
    {
      std::string         name;
      std::vector<double> openings;
    };

    std::vector<dealii::types::global_dof_index> dofs;
    std::vector<double>                          sign;
    std::vector<double>                          gap;

    /** With friction, the unknown of the jump along each tangent, for each
     * bound; invalid where there is none. */
    std::vector<std::vector<dealii::types::global_dof_index>> tangents;

    /** Unknowns with bounds on each face of the lips, of all ranks. */
    std::vector<std::vector<dealii::types::global_dof_index>> faces;

    /** Basis of the kernel of A: motions that only bounds can stop. The same on
     * all ranks; each motion opens some bound. */
    std::vector<FreeMotion> free_motions;
  };

  /**
   * The discrete variational inequality: minimise ½ qᵀAq − bᵀq under the
   * bounds; in other words (paper, §6; model, §3)
   *
   *     A q − b = Lᵀ g,      0 ≤ g ⟂ L q − gap ≥ 0.
   *
   * A is symmetric positive definite, except for free motions. This class knows
   * no finite elements, time or materials. Each solve has its right-hand side.
   */
  class SignoriniProblem
  {
  public:
    /** Both arguments must outlive the problem. @throw NumericalError if a
     * diagonal entry is not positive: A is not positive definite. */
    SignoriniProblem(const LinearOperator   &stiffness,
                     const UnilateralBounds &bounds);
    SignoriniProblem(const SparseMatrix     &matrix,
                     const UnilateralBounds &bounds);

  private:
    SignoriniProblem(std::shared_ptr<const LinearOperator> own,
                     const UnilateralBounds               &bounds);

    std::shared_ptr<const LinearOperator> of_matrix; ///< own operator, or null

  public:
    const LinearOperator &stiffness; ///< A

    const UnilateralBounds &bounds;

    /** A as a matrix, for methods that need its entries. A matrix-free operator
     * has none. */
    const SparseMatrix &
    matrix() const
    {
      AssertThrow(stiffness.matrix() != nullptr,
                  dealii::ExcMessage("The stiffness has no matrix."));
      return *stiffness.matrix();
    }

    /** Diagonal of A: the scale of forces, and the SOR sweep's divisor. */
    const Vector &
    diagonal() const
    {
      return stiffness.diagonal();
    }

    /** Stiffnesses of springs at the locally owned bounds that make A positive
     * definite in spite of free motions. A solution without springs is the
     * limit of solutions whose springs are relaxed in the previous one. */
    std::vector<double>
    springs() const;

    /** Values of all bounds from those of each rank. Collective. */
    dealii::Vector<double>
    of_all(const std::vector<double> &local) const;

    /** Number of contact bounds on all ranks. */
    dealii::types::global_dof_index
    n_bounds() const
    {
      return all_dofs.size();
    }

    /** Unknowns with bounds on all ranks, rank by rank. */
    const LinearOperator::Indices &
    all_bounded_dofs() const
    {
      return all_dofs;
    }

    /** With friction, the unknowns along each tangent at the bounds on all
     * ranks, in the order of all_bounded_dofs(); invalid where there is none.
     */
    const std::vector<LinearOperator::Indices> &
    all_tangents() const
    {
      return tangents;
    }

    /** Unknowns of the condensed problem: those with bounds, then the valid
     * ones of each tangent. */
    LinearOperator::Indices
    all_lip_dofs() const;

  private:
    LinearOperator::Indices              all_dofs;
    std::vector<LinearOperator::Indices> tangents;
  };
} // namespace Crevasse

#endif
