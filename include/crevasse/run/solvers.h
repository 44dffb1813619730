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
#include <crevasse/scene/scene.h>
#include <crevasse/time/evolution.h>
#include <crevasse/time/step_list.h>

#include <map>
#include <memory>
#include <optional>

namespace Crevasse
{
  /**
   * The material and the contact system of any instant. With a stiffness that
   * is constant but for a factor there is one system for all of them. Otherwise
   * each instant has its own, which is kept for the same instant of later
   * periods as long as the memory that the scene grants lasts; what does not
   * fit is made anew each time. Those that were made first are kept: where
   * instants come in turn, dropping the oldest would always drop the next.
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

    /** The elastic displacement under the given loads with the lip open or
     * held at u_N = 0. For a constant stiffness. */
    Vector
    elastic_displacement(const Vector &loads, const bool lip_closed);

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
    /** What belongs to one instant. */
    struct Entry
    {
      MaterialState<dim>                  material;
      std::unique_ptr<ContactSystem<dim>> system; ///< null: the only one
    };

    Entry
    make_entry(const double t);

    std::size_t
    memory_consumption(const Entry &entry) const;

    /** The entry of an instant, made if need be. */
    Entry &
    entry_at(const double t);

    /** By the largest nodal force of all steps. */
    double
    largest_load(const StepList &steps) const;

    double
    relaxation_factor(const SparseMatrix &matrix, const StepList &steps);

    const Scene     &scene;
    const Body<dim> &body;
    Log             &log;

    const UnilateralBounds              bounds;
    std::optional<double>               sor_factor; ///< once it was searched
    SolverSettings                      solver_settings;
    std::unique_ptr<ContactSystem<dim>> only_system; ///< constant stiffness
    ContactSystem<dim>                 *last_system = nullptr;

    std::map<double, Entry> kept;
    std::optional<Entry>    scratch; ///< an instant that is not kept
    double                  scratch_time = 0.;
    std::size_t             kept_bytes   = 0;
    bool                    is_full      = false;
    SolverStatistics        of_the_past;
  };

  /** The step of a period at which the load vector is largest. */
  template <int dim>
  unsigned int
  step_of_largest_load(const Body<dim> &body, const StepList &steps);

  /** The load vector at an instant of the period. */
  template <int dim>
  Vector
  loads_at(const Body<dim> &body, const double t);
} // namespace Crevasse

#endif
