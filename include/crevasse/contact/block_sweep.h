// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_contact_block_sweep_h
#define crevasse_contact_block_sweep_h

#include <crevasse/contact/sweep.h>
#include <crevasse/linear/matrix_rows.h>

#include <deal.II/base/tensor.h>

#include <array>
#include <vector>

namespace Crevasse
{
  /** Block by block: the unknowns of a node are relaxed together by their
   * block of A, and projected in the norm of that block (Glowinski, Numerical
   * Methods for Nonlinear Variational Problems, 1984, ch. V). */
  class BlockSweep : public Sweep
  {
  public:
    BlockSweep(const SignoriniProblem &problem, const UnknownBlocks &blocks);

    double
    operator()(const Vector &right_hand_side,
               Vector       &solution,
               const double  relaxation_factor) const override;

  private:
    using SmallVector = dealii::Tensor<1, 3>;
    using SmallMatrix = dealii::Tensor<2, 3>;

    /** A block of A, filled up by the identity, and the bounds on it. */
    struct Block
    {
      unsigned int       size = 0;
      std::array<int, 3> unknown;
      std::array<int, 3> bound = {{-1, -1, -1}}; ///< or −1
      SmallMatrix        matrix;
      SmallMatrix        inverse;
      unsigned int       bounded = 0; ///< bit set of the bounded ones
    };

    /** The largest violation of a bound by @p y, at least 0. */
    double
    penetration(const Block &block, const SmallVector &y) const;

    /** Of all points within the bounds the nearest to @p z in the norm of the
     * block's matrix. */
    SmallVector
    project(const Block &block, const SmallVector &z) const;

    /** The nearest one with the bounds of a bit set as equations, and by how
     * much it violates the others, or its forces the sign. */
    SmallVector
    project_on(const Block       &block,
               const unsigned int set,
               const SmallVector &z,
               double            &violation) const;

    /** b − Aq in the block's rows. */
    SmallVector
    residual(const Block &block, const double *b, const double *q) const;

    const SignoriniProblem &problem;
    const MatrixRows        rows;
    std::vector<Block>      blocks;
  };
} // namespace Crevasse

#endif
