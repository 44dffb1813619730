// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_periodic_march_h
#define crevasse_periodic_march_h

#include <crevasse/periodic/contraction.h>
#include <crevasse/periodic/observed_periods.h>

namespace Crevasse
{
  /**
   * Integrates the Cauchy problem until the stress repeats (the paper's §6.2).
   * The paper judges by the change of stress from one period to the next;
   * march() judges by the Contraction of this change and, unless the whole lip
   * continues to open, by the ReturnDefect of the viscous strain.
   *
   * @param periods end when the estimated error of the stress, relative to its
   * maximum, is within their tolerance.
   * @param slowness 1/(1−λ) with the contraction λ of the slowest point by
   * itself, the final rate of decrease; 1: unknown.
   * @param creep_exponent exponent n of Contraction.
   * @param r viscous strain at the beginning; on return, at the end.
   */
  template <int dim>
  void
  march(ObservedPeriods<dim> &periods,
        const double          slowness,
        const double          creep_exponent,
        Vector               &r)
  {
    Contraction              contraction(creep_exponent);
    bool                     is_first = true;
    const SerializationScope part(periods.checkpointer(),
                                  [&](StateArchive &archive) {
                                    archive.section("march");
                                    contraction.serialize(archive);
                                    archive.common(is_first);
                                  });
    periods.ignore_drift_while_opening();
    for (; periods.begins_another(r); is_first = false)
      {
        const double change = periods.compute(r);
        // std::max() returns its first argument if that is nan.
        periods.report(
          periods.remembers()
            ? std::max({contraction.add(change, !is_first, periods.rounding()),
                        (slowness - 1.) * change,
                        periods.return_defect()})
            : 0.);
      }
  }
} // namespace Crevasse

#endif
