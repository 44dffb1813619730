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

#include <crevasse/run/instant_cache.h>

#include <utility>

namespace Crevasse
{
  using namespace dealii;

  template <int dim>
  InstantCache<dim>::InstantCache(const Body<dim> &body,
                                  const double     bytes,
                                  Log             &log)
    : body(body)
    , limit(bytes)
    , log(log)
  {
  }



  template <int dim>
  double
  InstantCache<dim>::memory_consumption(const InstantEntry<dim> &entry) const
  {
    std::size_t bytes = body.material.memory_of_variation(entry.material);
    if (entry.system != nullptr)
      bytes += entry.system->memory_consumption();
    return Utilities::MPI::sum(double(bytes), body.space.communicator());
  }



  template <int dim>
  double
  InstantCache<dim>::kept_memory() const
  {
    double bytes = 0.;
    for (const auto &[t, entry] : kept)
      bytes += memory_consumption(entry);
    return bytes;
  }



  template <int dim>
  InstantEntry<dim> &
  InstantCache<dim>::at(const double t, const Make &make)
  {
    if (const auto found = kept.find(t); found != kept.end())
      return found->second;
    if (scratch && scratch_time == t)
      return *scratch;

    InstantEntry<dim> entry = make();
    if (!is_full && kept_memory() + memory_consumption(entry) <= limit)
      return kept.emplace(t, std::move(entry)).first->second;
    if (!is_full)
      log.line("  memory: " + std::to_string(kept.size()) +
               " instants are kept; what varies in time is made anew for the "
               "others ([Linear solver] Memory for instants)");
    is_full = true;
    if (scratch && scratch->system != nullptr)
      of_the_past.add(scratch->system->statistics());
    scratch      = std::move(entry);
    scratch_time = t;
    return *scratch;
  }



  template <int dim>
  SolverStatistics
  InstantCache<dim>::statistics() const
  {
    SolverStatistics all = of_the_past;
    for (const auto &[t, entry] : kept)
      if (entry.system != nullptr)
        all.add(entry.system->statistics());
    if (scratch && scratch->system != nullptr)
      all.add(scratch->system->statistics());
    return all;
  }



  template class InstantCache<2>;
  template class InstantCache<3>;
} // namespace Crevasse
