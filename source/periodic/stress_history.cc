// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/state_archive.h>
#include <crevasse/periodic/stress_history.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>

namespace Crevasse
{
  StressHistory::StressHistory(const double period)
    : rounding(1e-12 * period)
  {
  }



  void
  StressHistory::record(const double t, const Vector &stress)
  {
    auto found = samples.lower_bound(t - rounding);
    if (found == samples.end() || found->first > t + rounding)
      {
        found        = samples.emplace(t, Entry()).first;
        communicator = stress.get_mpi_communicator();
        if (periods == 0)
          found->second.stress.reinit(stress);
        else
          {
            ++n_new;
            found->second.stress = stress;
          }
      }
    found->second.period = periods;
    Vector &stored       = found->second.stress;
    for (unsigned int i = 0; i < stress.locally_owned_size(); ++i)
      {
        const double s = stress.local_element(i);
        if (const double change = std::abs(s - stored.local_element(i));
            change > largest_change.change)
          largest_change = {change, i};
        largest                 = std::max(largest, std::abs(s));
        stored.local_element(i) = s;
      }
  }



  double
  StressHistory::take_change()
  {
    const double change =
      dealii::Utilities::MPI::max(largest_change.change, communicator);
    largest_of_last = dealii::Utilities::MPI::max(largest, communicator);
    for (auto entry = samples.begin(); entry != samples.end();)
      if (entry->second.period == periods)
        ++entry;
      else
        entry = samples.erase(entry);
    ++periods;
    comparable     = 4 * n_new <= samples.size();
    n_new          = 0;
    place_of_last  = largest_change;
    largest_change = Place();
    largest        = 0.;
    return change > 0. ? change / largest_of_last : 0.;
  }



  void
  StressHistory::serialize(StateArchive &archive)
  {
    std::size_t n = samples.size();
    archive.common(n);
    if (archive.is_loading())
      samples.clear();
    auto next = samples.begin();
    for (std::size_t k = 0; k < n; ++k)
      {
        double t = archive.is_loading() ? 0. : next->first;
        archive.common(t);
        if (archive.is_loading())
          next = samples.emplace_hint(samples.end(), t, Entry());
        archive.common(next->second.period);
        archive.at_points(next->second.stress);
        ++next;
      }
    archive.common(periods);
    archive.common(n_new);
    archive.common(comparable);
    archive.maximum(largest_change.change);
    archive.maximum(largest);
    archive.common(largest_of_last);
    communicator = archive.communicator();
  }
} // namespace Crevasse
