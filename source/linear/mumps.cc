// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/collectively.h>
#include <crevasse/base/problems.h>
#include <crevasse/linear/mumps.h>

namespace Crevasse
{
  Mumps::Mumps(const Matrix &matrix, const Indices &lip)
    : DirectSolver(lip)
    , factor(matrix.get_mpi_communicator(),
             matrix.local_size(),
             lip,
             "the stiffness",
             "Use more ranks or [Linear solver] Type = amg.",
             "Check the moduli of [Material] and the supports of [Boundary].")
  {
    UpperTriangle<double> triangle = upper_triangle(matrix);
    factor.factorise(triangle);
    schur_complement.swap(factor.schur_complement); // no copy
    lip_factor = schur_complement;
    lip_factor.set_property(dealii::LAPACKSupport::symmetric);
    collectively(factor.communicator, [&]() {
      // Without pivoting, the matrix is positive definite if no pivot is < 0.
      bool is_positive = factor.data.infog[11] == 0;
      try
        {
          if (is_positive && !lip.empty())
            lip_factor.compute_cholesky_factorization();
        }
      catch (const dealii::ExceptionBase &)
        {
          is_positive = false;
        }
      if (!is_positive)
        throw NumericalError(
          "MUMPS: the stiffness is not positive definite. Check the moduli of "
          "[Material] and the supports of [Boundary].");
    });
  }



  void
  Mumps::precondition(Vector &solution, const Vector &right_hand_side)
  {
    std::vector<double> on_root = factor.gather(right_hand_side.begin());
    factor.solve(on_root, [&](LipVector &on_lip) { lip_factor.solve(on_lip); });
    factor.scatter(on_root, solution.begin());
  }



  void
  Mumps::solve_with_lip(Vector           &solution,
                        const Vector     &right_hand_side,
                        const LipProblem &lip_problem)
  {
    const Stopwatch     watch("linear solves");
    std::vector<double> on_root = factor.gather(right_hand_side.begin());
    factor.solve(on_root, lip_problem);
    factor.scatter(on_root, solution.begin());
    ++solves;
  }
} // namespace Crevasse
