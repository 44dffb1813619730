// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/periodic/march.h>

#include <algorithm>

namespace Crevasse
{
  template <int dim>
  March<dim>::March(ObservedPeriods<dim> &periods,
                    const double          tolerance,
                    const double          slowness)
    : periods(periods)
    , tolerance(tolerance)
    , slowness(slowness)
  {
  }



  template <int dim>
  ConvergenceStatus
  March<dim>::run(Vector &r)
  {
    const SerializationScope part(periods.checkpointer(),
                                  [this](StateArchive &archive) {
                                    archive.section("march");
                                    contraction.serialize(archive);
                                    archive.common(is_first);
                                  });
    periods.ignore_drift_while_opening();
    for (; periods.may_go_on(); is_first = false)
      {
        const double change = periods.compute(r);
        if (!periods.has_memory())
          {
            periods.report(0.);
            return ConvergenceStatus::converged;
          }
        // max() gives back its first argument if that is nan.
        const double error = std::max({contraction.add(change, !is_first),
                                       (slowness - 1.) * change,
                                       periods.return_defect()});
        periods.report(error);
        if (tolerance > 0. && error <= tolerance)
          return ConvergenceStatus::converged;
      }
    periods.stop_before(r);
    return ConvergenceStatus::out_of_periods;
  }



  template class March<2>;
  template class March<3>;
} // namespace Crevasse
