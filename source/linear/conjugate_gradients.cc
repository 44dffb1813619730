// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/problems.h>
#include <crevasse/linear/cg_iteration.h>
#include <crevasse/linear/conjugate_gradients.h>

#include <sstream>

namespace Crevasse
{
  std::string
  ConjugateGradients::description() const
  {
    return "conjugate gradients with " + preconditioner_description();
  }



  unsigned int
  ConjugateGradients::apply_inverse(Vector       &solution,
                                    const Vector &right_hand_side,
                                    const double  residual_norm)
  {
    hold({});
    const CgResult result = iterate_cg(
      [this](Vector &product, const Vector &v) { multiply(product, v); },
      [this](Vector &product, const Vector &v) { precondition(product, v); },
      solution,
      right_hand_side,
      residual_norm);
    if (!result.has_converged)
      {
        std::ostringstream message;
        message << "The conjugate gradients with multigrid did not reach the "
                   "residual "
                << residual_norm << " in " << result.n_iterations
                << " iterations: they ended at " << result.residual_norm
                << ". Check [Material] for extreme contrasts and the mesh for "
                   "degenerate cells; raise [Contact] Tolerance; or use "
                   "[Linear solver] Type = cholesky or mumps.";
        throw NumericalError(message.str());
      }
    return result.n_iterations;
  }
} // namespace Crevasse
