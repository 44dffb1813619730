// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_simulation_memory_prediction_h
#define crevasse_simulation_memory_prediction_h

#include <crevasse/base/log.h>
#include <crevasse/linear/solver_choice.h>
#include <crevasse/model/body.h>
#include <crevasse/parameters/scene.h>
#include <crevasse/periodic/periodic_choice.h>
#include <crevasse/time/step_list.h>

namespace Crevasse
{
  /** Bytes that a run needs on one rank at its peak, by what needs them. */
  struct MemoryPrediction
  {
    double libraries; ///< and what else the smallest scene needs
    double mesh;      ///< with the numbers of its unknowns
    double fields;    ///< at quadrature points, and vectors of unknowns
    double matrix;
    double solver; ///< factor or multigrid, of all instants that are kept
    double search; ///< for the periodic state
    double output; ///< instants kept for the fields, and writing one

    double
    total() const;
  };

  /** Of this rank. Formulas with constants that were measured. Collective. */
  template <int dim>
  MemoryPrediction
  predict_memory(const Body<dim>      &body,
                 const StepList       &steps,
                 const Scene          &scene,
                 const PeriodicChoice &choice);

  /** Prints what the largest rank is going to need. Collective.
   * @throw SceneError if the ranks on a machine need more than it has left,
   * with what would fit. */
  template <int dim>
  void
  describe_memory(const Body<dim>      &body,
                  const StepList       &steps,
                  const Scene          &scene,
                  const PeriodicChoice &choice,
                  Log                  &log);
} // namespace Crevasse

#endif
