// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/time/event_functions.h>

#include <algorithm>
#include <cmath>

namespace Crevasse
{
  EventFunctions::EventFunctions(RememberedRate &equation)
    : equation(equation)
  {
  }



  std::vector<double>
  EventFunctions::gather(const MPI_Comm communicator) const
  {
    std::vector<double> mine, all;
    equation.last().switching_functions(mine);
    for (const std::vector<double> &values :
         dealii::Utilities::MPI::all_gather(communicator, mine))
      all.insert(all.end(), values.begin(), values.end());
    return all;
  }



  unsigned int
  EventFunctions::count(const Vector &r)
  {
    return gather(r.get_mpi_communicator()).size();
  }



  void
  EventFunctions::evaluate(const double t, const Vector &r, double *values)
  {
    constexpr double band = 1e-5;
    rate.reinit(r, true);
    equation.show(t, r, rate);
    const std::vector<double> all = gather(r.get_mpi_communicator());
    for (const double value : all)
      largest = std::max(largest, std::abs(value));
    std::transform(all.begin(), all.end(), values, [this](const double value) {
      return std::abs(value) <= band * largest ? 0. : value;
    });
  }
} // namespace Crevasse
