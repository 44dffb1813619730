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

#ifndef crevasse_run_solvers_h
#define crevasse_run_solvers_h

#include <crevasse/output/log.h>
#include <crevasse/run/body.h>
#include <crevasse/run/contact_system.h>
#include <crevasse/run/instant_cache.h>
#include <crevasse/scene/scene.h>
#include <crevasse/time/evolution.h>
#include <crevasse/time/step_list.h>

#include <memory>
#include <optional>

namespace Crevasse
{
  /**
   * The material and the contact system of any instant. With a stiffness that
   * is constant but for a factor there is one system for all of them. Otherwise
   * each instant has its own, which InstantCache keeps.
   */
  template <int dim>
  class Solvers
  {
  public:
    /** All arguments must outlive this object. */
    Solvers(const Scene         &scene,
            const Body<dim>     &body,
            const StepList      &steps,
            Log                 &log,
            dealii::TimerOutput &phases);

    // Its parts refer to one another.
    Solvers(const Solvers &) = delete;
    Solvers &
    operator=(const Solvers &) = delete;

    /** See Instants. */
    Instant<dim>
    at(const double t);

    /** The stiffness without its factor, and its contact problem, of the
     * instant for which at() was called last; before, that of t = 0. */
    ContactSystem<dim> &
    current();

    /** See SolverSettings. */
    const SolverSettings &
    settings() const;

    /** The factor of projected SOR for a matrix: what the scene says, or the
     * best one for the given loads. */
    double
    relaxation_factor(const SparseMatrix &matrix, const Vector &loads) const;

    /** Of all systems that there were. */
    SolverStatistics
    statistics() const;

    /** Counts what another system of this run has done. */
    void
    add(const SolverStatistics &other);

    /** Which solvers there are and why, how often they were called and what it
     * took. */
    void
    summarise(Summary &summary) const;

  private:
    InstantEntry<dim>
    make_entry(const double t);

    const Scene     &scene;
    const Body<dim> &body;
    Log             &log;

    const UnilateralBounds              bounds;
    std::optional<double>               sor_factor; ///< once it was searched
    SolverSettings                      solver_settings;
    std::unique_ptr<ContactSystem<dim>> only_system; ///< constant stiffness
    ContactSystem<dim>                 *last_system = nullptr;

    InstantCache<dim> instants;
    SolverStatistics  of_the_past;
  };
} // namespace Crevasse

#endif
