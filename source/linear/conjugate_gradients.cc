// ---------------------------------------------------------------------
//
// Copyright (C) 2026 by the Crevasse authors
//
// This file is part of Crevasse. It is free software; you can use it,
// redistribute it and/or modify it under the terms of the GNU Lesser
// General Public License as published by the Free Software Foundation;
// either version 2.1 of the License, or (at your option) any later version.
//
// ---------------------------------------------------------------------
#include <crevasse/linear/conjugate_gradients.h>
#include <crevasse/scene/problems.h>

#include <deal.II/lac/solver_cg.h>
#include <deal.II/lac/solver_control.h>

#include <sstream>

namespace Crevasse
{
  using namespace dealii;

  bool
  ConjugateGradients::is_direct() const
  {
    return false;
  }



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
    struct Product
    {
      void
      vmult(Vector &result, const Vector &v) const
      {
        solver.multiply(result, v);
      }

      const ConjugateGradients &solver;
    };
    struct Preconditioner
    {
      void
      vmult(Vector &result, const Vector &v) const
      {
        solver.precondition(result, v);
      }

      ConjugateGradients &solver;
    };

    constexpr unsigned int maximum_iterations = 1000;
    SolverControl          control(maximum_iterations, residual_norm);
    SolverCG<Vector>       cg(control);
    hold({});
    try
      {
        cg.solve(Product{*this},
                 solution,
                 right_hand_side,
                 Preconditioner{*this});
      }
    catch (const SolverControl::NoConvergence &error)
      {
        std::ostringstream message;
        message << "The conjugate gradients with multigrid did not reach the "
                   "residual "
                << residual_norm << " in " << error.last_step
                << " iterations: they ended at " << error.last_residual
                << ". Check [Material] for extreme contrasts and the mesh for "
                   "degenerate cells; raise [Contact] Tolerance; or use "
                   "[Linear solver] Type = cholesky or mumps.";
        throw NumericalError(message.str());
      }
    return control.last_step();
  }
} // namespace Crevasse
