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

#include <crevasse/periodic/stress_history.h>

#include <deal.II/base/array_view.h>
#include <deal.II/base/mpi.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace Crevasse
{
  StressHistory::StressHistory(const unsigned int n_samples)
    : samples(n_samples)
  {
  }



  void
  StressHistory::record(const unsigned int sample, const Vector &stress)
  {
    Vector &stored = samples[sample];
    if (stored.size() == 0)
      {
        stored.reinit(stress);
        communicator = stress.get_mpi_communicator();
      }
    for (unsigned int i = 0; i < stress.locally_owned_size(); ++i)
      {
        const double s = stress.local_element(i);
        largest_change =
          std::max(largest_change, std::abs(s - stored.local_element(i)));
        largest                 = std::max(largest, std::abs(s));
        stored.local_element(i) = s;
      }
  }



  double
  StressHistory::take_change()
  {
    std::array<double, 2> values{{largest_change, largest}};
    dealii::Utilities::MPI::max(
      dealii::ArrayView<const double>(values.data(), values.size()),
      communicator,
      dealii::ArrayView<double>(values.data(), values.size()));
    largest_of_last = values[1];
    largest_change  = 0.;
    largest         = 0.;
    return values[0] > 0. ? values[0] / values[1] : 0.;
  }



  double
  StressHistory::largest_stress() const
  {
    return largest_of_last;
  }
} // namespace Crevasse
