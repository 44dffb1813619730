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

#ifndef crevasse_run_instant_cache_h
#define crevasse_run_instant_cache_h

#include <crevasse/output/log.h>
#include <crevasse/run/body.h>
#include <crevasse/run/contact_system.h>

#include <functional>
#include <map>
#include <memory>
#include <optional>

namespace Crevasse
{
  /** What belongs to one instant of the period. */
  template <int dim>
  struct InstantEntry
  {
    MaterialState<dim>                  material;
    std::unique_ptr<ContactSystem<dim>> system; ///< null: that of all instants
  };

  /**
   * Keeps what belongs to instants for the same instants of later periods, as
   * long as the memory that the scene grants lasts; what does not fit is made
   * anew each time. Those that were made first are kept: where instants come in
   * turn, dropping the oldest would always drop the next.
   */
  template <int dim>
  class InstantCache
  {
  public:
    using Make = std::function<InstantEntry<dim>()>;

    /** @param bytes of all ranks. All arguments must outlive this object. */
    InstantCache(const Body<dim> &body, const double bytes, Log &log);

    /** The entry of an instant, made if need be; it lasts until the next call.
     * Collective. */
    InstantEntry<dim> &
    at(const double t, const Make &make);

    /** Of all systems that there were. */
    SolverStatistics
    statistics() const;

  private:
    /** Of all ranks. */
    double
    memory_consumption(const InstantEntry<dim> &entry) const;

    /** Of what is kept: contact solvers grow while they work. */
    double
    kept_memory() const;

    const Body<dim> &body;
    const double     limit;
    Log             &log;

    std::map<double, InstantEntry<dim>> kept;
    std::optional<InstantEntry<dim>>    scratch; ///< an instant not kept
    double                              scratch_time = 0.;
    bool                                is_full      = false;
    SolverStatistics                    of_the_past;
  };
} // namespace Crevasse

#endif
