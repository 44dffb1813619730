// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_linear_amg_cg_h
#define crevasse_linear_amg_cg_h

#include <crevasse/linear/conjugate_gradients.h>
#include <crevasse/linear/matrix_operator.h>

#include <deal.II/lac/trilinos_precondition.h>

namespace Crevasse
{
  /** Conjugate gradients with smoothed aggregation (Trilinos ML) as
   * preconditioner, on any number of ranks. */
  class AmgCg : public ConjugateGradients
  {
  public:
    /**
     * Sets the multigrid hierarchy up.
     *
     * @param near_null_space vectors of small energy, which the coarse spaces
     * are to contain: the rigid motions.
     * @param block_size numbers of unknowns at a node; consecutive in A.
     * @param higher_order whether the elements are of degree 2 or more.
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
