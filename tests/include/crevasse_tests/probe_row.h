// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_tests_probe_row_h
#define crevasse_tests_probe_row_h

#include <crevasse/postprocess/probe.h>

#include <deal.II/base/mpi.h>

#include <vector>

/** What the table of a probe has for a state, whose fields that are empty are
 * zero. */
template <int dim>
std::vector<double>
probe_row(const Crevasse::ProbeEvaluator<dim>  &probe,
          const Crevasse::Space<dim>           &space,
          const Crevasse::QuadratureField<dim> &points,
          Crevasse::State                       state)
{
  if (state.displacement.size() == 0)
    state.displacement = space.ghosted_vector();
  if (state.stress.size() == 0)
    points.initialize(state.stress);
  const Crevasse::Vector none;
  auto values = probe.local_values({1, 0, 0., 0., state, none, none, nullptr});
  for (double &value : values)
    value = dealii::Utilities::MPI::sum(value, MPI_COMM_WORLD);
  return probe.row(0., values);
}

#endif
