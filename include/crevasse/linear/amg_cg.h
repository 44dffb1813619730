// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_linear_amg_cg_h
#define crevasse_linear_amg_cg_h

#include <crevasse/linear/conjugate_gradients.h>
#include <crevasse/linear/matrix_operator.h>

#include <deal.II/lac/trilinos_precondition.h>

namespace Crevasse
{
  /** Conjugate gradients preconditioned by smoothed aggregation (Trilinos ML),
   * on any number of ranks. */
  class AmgCg : public ConjugateGradients
  {
  public:
    /**
     * Sets up the multigrid hierarchy.
     *
     * @param near_null_space Vectors of small energy for the coarse spaces: the
     * rigid-body modes.
     * @param block_size Number of unknowns at a node, consecutive in A.
     * @param higher_order Whether the elements have degree 2 or more.
     */
    AmgCg(const Matrix              &matrix,
          const std::vector<Vector> &near_null_space,
          const unsigned int         block_size,
          const bool                 higher_order);

    void
    precondition(Vector &solution, const Vector &right_hand_side) override
    {
      multigrid.vmult(solution, right_hand_side);
    }

    std::size_t
    memory_consumption() const override
    {
      return multigrid.memory_consumption();
    }

    std::string
    preconditioner_description() const override
    {
      return "smoothed aggregation (ML)";
    }

  protected:
    void
    multiply(Vector &result, const Vector &v) const override
    {
      Crevasse::multiply(matrix, result, v);
    }

  private:
    const Matrix                             &matrix;
    dealii::TrilinosWrappers::PreconditionAMG multigrid;
  };
} // namespace Crevasse

#endif
