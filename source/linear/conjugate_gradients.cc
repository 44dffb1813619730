// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/problems.h>
#include <crevasse/base/text.h>
#include <crevasse/linear/conjugate_gradients.h>

namespace Crevasse
{
  unsigned int
  ConjugateGradients::apply_inverse(Vector       &solution,
                                    const Vector &right_hand_side,
                                    const double  residual_norm)
  {
    hold({});
    const auto end = iterate(
      [this](Vector &product, const Vector &v) { multiply(product, v); },
      [this](Vector &product, const Vector &v) { precondition(product, v); },
      solution,
      right_hand_side,
      residual_norm);
    if (end.last_check() != dealii::SolverControl::success)
      throw NumericalError(
        Text::Message()
        << "The conjugate gradients with multigrid did not reach the "
           "residual "
        << residual_norm << " in " << end.last_step()
        << " iterations: they ended at " << end.last_value()
        << ". Check [Material] for extreme contrasts and the mesh for "
           "degenerate cells; raise [Contact] Tolerance; or use "
           "[Linear solver] Type = cholesky or mumps.");
    return end.last_step();
  }
} // namespace Crevasse
