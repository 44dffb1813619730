// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/periodic/contraction.h>
#include <crevasse/periodic/march.h>


namespace Crevasse
{
  template <int dim>
  ConvergenceStatus
  march(ObservedPeriods<dim> &periods,
        const double          tolerance,
        const double          slowness,
        Vector               &r)
  {
    Contraction              contraction;
    bool                     is_first = true;
    const SerializationScope part(periods.checkpointer(),
                                  [&](StateArchive &archive) {
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



  template ConvergenceStatus
  march<2>(ObservedPeriods<2> &, const double, const double, Vector &);
  template ConvergenceStatus
  march<3>(ObservedPeriods<3> &, const double, const double, Vector &);
} // namespace Crevasse
