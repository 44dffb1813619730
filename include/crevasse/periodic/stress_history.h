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

#ifndef crevasse_periodic_stress_history_h
#define crevasse_periodic_stress_history_h

#include <deal.II/lac/la_parallel_vector.h>

#include <vector>

namespace Crevasse
{
  using Vector = dealii::LinearAlgebra::distributed::Vector<double>;

  /** The stress at all samples of one period, and how much each differs from
   * the sample that it replaces. */
  class StressHistory
  {
  public:
    explicit StressHistory(const unsigned int n_samples);

    void
    record(const unsigned int sample, const Vector &stress);

    /** Largest change since the last call, relative to the largest stress
     * component (0 if all stress is zero), over all ranks; then starts anew. */
    double
    take_change();

    /** Largest stress component of the last period for which take_change() was
     * called. */
    double
    largest_stress() const;

  private:
    std::vector<Vector> samples;
    MPI_Comm            communicator    = MPI_COMM_SELF;
    double              largest_change  = 0.;
    double              largest         = 0.;
    double              largest_of_last = 0.;
  };
} // namespace Crevasse

#endif
