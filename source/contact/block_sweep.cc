// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/contact/block_sweep.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace Crevasse
{
  using namespace dealii;

  BlockSweep::BlockSweep(const SignoriniProblem &problem,
                         const UnknownBlocks    &unknown_blocks)
    : problem(problem)
    , rows(problem.matrix())
  {
    std::vector<int> bound_of(rows.n, -1);
    for (unsigned int k = 0; k < problem.bounds.dofs.size(); ++k)
      bound_of[problem.bounds.dofs[k]] = k;

    for (const auto &unknowns : unknown_blocks)
      {
        Assert(unknowns.size() <= 3, ExcMessage("A block is a node."));
        Block block;
        block.size   = unknowns.size();
        block.matrix = unit_symmetric_tensor<3>();
        for (unsigned int i = 0; i < block.size; ++i)
          {
            block.unknown[i] = unknowns[i];
            block.bound[i]   = bound_of[unknowns[i]];
            block.bounded |= (block.bound[i] >= 0 ? 1u : 0u) << i;
            for (unsigned int j = 0; j < block.size; ++j)
              block.matrix[i][j] =
                problem.matrix().el(unknowns[i], unknowns[j]);
          }
        block.inverse = invert(block.matrix);
        blocks.push_back(block);
      }
  }



  double
  BlockSweep::penetration(const Block &block, const SmallVector &y) const
  {
    const UnilateralBounds &bounds  = problem.bounds;
    double                  largest = 0.;
    for (unsigned int i = 0; i < block.size; ++i)
      if (const int k = block.bound[i]; k >= 0)
        largest = std::max(largest, bounds.gap[k] - bounds.sign[k] * y[i]);
    return largest;
  }



  BlockSweep::SmallVector
  BlockSweep::project(const Block &block, const SmallVector &z) const
  {
    // At most three bounds: every set of them is tried. Strict convexity leaves
    // one without penetration and tension; rounding may leave traces of them.
    SmallVector nearest         = z;
    double      least_violation = std::numeric_limits<double>::max();
    for (unsigned int set = 1; set < (1u << block.size); ++set)
      if ((set & ~block.bounded) == 0)
        {
          double            violation;
          const SmallVector y = project_on(block, set, z, violation);
          if (violation < least_violation)
            {
              least_violation = violation;
              nearest         = y;
            }
        }
    return nearest;
  }



  BlockSweep::SmallVector
  BlockSweep::project_on(const Block       &block,
                         const unsigned int set,
                         const SmallVector &z,
                         double            &violation) const
  {
    const UnilateralBounds &bounds = problem.bounds;
    SmallMatrix             system = block.matrix;
    SmallVector             right  = block.matrix * z;
    for (unsigned int i = 0; i < block.size; ++i)
      if ((set >> i) & 1)
        {
          const int k  = block.bound[i];
          system[i]    = SmallVector();
          system[i][i] = 1.;
          right[i]     = bounds.sign[k] * bounds.gap[k];
        }

    SmallVector       y      = invert(system) * right;
    const SmallVector forces = block.matrix * (y - z);
    violation                = penetration(block, y);
    for (unsigned int i = 0; i < block.size; ++i)
      if ((set >> i) & 1)
        {
          y[i]      = right[i]; // exactly
          violation = std::max(violation,
                               -bounds.sign[block.bound[i]] * forces[i] /
                                 block.matrix[i][i]);
        }
    return y;
  }



  BlockSweep::SmallVector
  BlockSweep::residual(const Block  &block,
                       const double *b,
                       const double *q) const
  {
    SmallVector result;
    for (unsigned int i = 0; i < block.size; ++i)
      {
        const int row = block.unknown[i];
        result[i]     = b[row];
        for (int k = rows.starts[row]; k < rows.starts[row + 1]; ++k)
          result[i] -= rows.values[k] * q[rows.columns[k]];
      }
    return result;
  }



  double
  BlockSweep::operator()(const Vector &right_hand_side,
                         Vector       &solution,
                         const double  relaxation_factor) const
  {
    double *const       q = solution.begin();
    const double *const b = right_hand_side.begin();

    double largest_residual = 0., sum = 0.;
    for (const Block &block : blocks)
      {
        SmallVector       r        = residual(block, b, q);
        const SmallVector movement = relaxation_factor * (block.inverse * r);
        SmallVector       last;
        for (unsigned int i = 0; i < block.size; ++i)
          last[i] = q[block.unknown[i]];
        SmallVector next = last + movement;
        if (block.bounded != 0 && penetration(block, next) > 0.)
          {
            // As in the sweep by points: what still moves is what lacks.
            next = project(block, next);
            r    = block.matrix * (next - last);
          }
        for (unsigned int i = 0; i < block.size; ++i)
          {
            q[block.unknown[i]] = next[i];
            sum += next[i];
            largest_residual = std::max(largest_residual, std::abs(r[i]));
          }
      }
    return std::isfinite(sum) ? largest_residual
                              : std::numeric_limits<double>::infinity();
  }
} // namespace Crevasse
