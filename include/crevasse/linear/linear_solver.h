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

#ifndef crevasse_linear_linear_solver_h
#define crevasse_linear_linear_solver_h

#include <deal.II/base/timer.h>
#include <deal.II/lac/la_parallel_vector.h>
#include <deal.II/lac/trilinos_sparse_matrix.h>

#include <cstddef>
#include <string>
#include <vector>

namespace Crevasse
{
  /** Solves A x = b many times with one symmetric positive definite A, which
   * the constructor of the derived class prepares. */
  class LinearSolver
  {
  public:
    using Vector = dealii::LinearAlgebra::distributed::Vector<double>;
    using Matrix = dealii::TrilinosWrappers::SparseMatrix;

    virtual ~LinearSolver() = default;

    void
    solve(Vector &solution, const Vector &right_hand_side)
    {
      const dealii::Timer timer;
      apply_inverse(solution, right_hand_side);
      wall_time += timer.wall_time();
      ++solves;
    }

    /** Solves for several right-hand sides at once; each is overwritten by its
     * solution. */
    void
    solve(std::vector<Vector> &right_hand_sides)
    {
      const dealii::Timer timer;
      apply_inverse(right_hand_sides);
      wall_time += timer.wall_time();
      solves += right_hand_sides.size();
    }

    std::size_t
    n_solves() const
    {
      return solves;
    }

    /** Wall time of all solves. */
    double
    seconds() const
    {
      return wall_time;
    }

    /** For the log and the summary. */
    virtual std::string
    description() const = 0;

  protected:
    virtual void
    apply_inverse(Vector &solution, const Vector &right_hand_side) = 0;

    /** One after the other, unless a solver knows better. */
    virtual void
    apply_inverse(std::vector<Vector> &right_hand_sides)
    {
      for (Vector &right_hand_side : right_hand_sides)
        {
          const Vector copy = right_hand_side;
          apply_inverse(right_hand_side, copy);
        }
    }

  private:
    std::size_t solves    = 0;
    double      wall_time = 0.;
  };
} // namespace Crevasse

#endif
