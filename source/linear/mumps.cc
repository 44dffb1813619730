// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/problems.h>
#include <crevasse/linear/mumps.h>
#include <crevasse/linear/mumps_instance.h>

namespace Crevasse
{
  struct Mumps::Factor : MumpsInstance<double>
  {
    explicit Factor(const Matrix &matrix)
      : MumpsInstance<double>(
          matrix.get_mpi_communicator(),
          matrix.local_size(),
          "the stiffness",
          "Use more ranks or [Linear solver] Type = amg.",
          "Check the moduli of [Material] and the supports of [Boundary].")
    {
      UpperTriangle<double> triangle = upper_triangle(matrix);
      factorise(triangle);
      // Without pivoting each pivot has its sign by Sylvester's law.
      const int n_negative = data.infog[11];
      if (n_negative != 0)
        throw NumericalError(
          "MUMPS: the stiffness is not positive definite (" +
          std::to_string(n_negative) +
          " negative pivots). Check the moduli of [Material] and the supports "
          "of [Boundary].");
    }
  };



  Mumps::Mumps(const Matrix &matrix)
    : factor(std::make_unique<Factor>(matrix))
  {
  }



  Mumps::~Mumps() = default;



  std::size_t
  Mumps::memory_consumption() const
  {
    return factor->memory_consumption();
  }



  std::string
  Mumps::description() const
  {
    return "MUMPS on " + std::to_string(factor->n_ranks) +
           (factor->n_ranks == 1 ? " rank" : " ranks");
  }



  void
  Mumps::back_solve(double            *solutions,
                    const double      *right_hand_sides,
                    const unsigned int n_columns)
  {
    std::vector<double> on_root = factor->gather(right_hand_sides, n_columns);
    factor->solve(on_root, n_columns);
    factor->scatter(on_root, solutions, n_columns);
  }
} // namespace Crevasse
