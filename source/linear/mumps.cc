// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/problems.h>
#include <crevasse/linear/mumps.h>

namespace Crevasse
{
  Mumps::Mumps(const Matrix &matrix)
    : factor(matrix.get_mpi_communicator(),
             matrix.local_size(),
             "the stiffness",
             "Use more ranks or [Linear solver] Type = amg.",
             "Check the moduli of [Material] and the supports of [Boundary].")
  {
    UpperTriangle<double> triangle = upper_triangle(matrix);
    factor.factorise(triangle);
    // Without pivoting each pivot has its sign by Sylvester's law.
    if (const int n_negative = factor.data.infog[11]; n_negative != 0)
      throw NumericalError(
        "MUMPS: the stiffness is not positive definite (" +
        std::to_string(n_negative) +
        " negative pivots). Check the moduli of [Material] and the supports "
        "of [Boundary].");
  }



  void
  Mumps::back_solve(double            *solutions,
                    const double      *right_hand_sides,
                    const unsigned int n_columns)
  {
    std::vector<double> on_root = factor.gather(right_hand_sides, n_columns);
    factor.solve(on_root, n_columns);
    factor.scatter(on_root, solutions, n_columns);
  }
} // namespace Crevasse
