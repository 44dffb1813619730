// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_periodic_march_h
#define crevasse_periodic_march_h

#include <crevasse/periodic/contraction.h>
#include <crevasse/periodic/observed_periods.h>

namespace Crevasse
{
  /**
   * The paper's method (§6.2): integrate the Cauchy problem until the stress
   * repeats. The paper judges by the change of stress from one period to the
   * next; this one by its Contraction, and unless all of the lip goes on to
   * open, by what the viscous strain lacks to return (ReturnDefect).
   *
   * @param periods which end when the estimated error of the stress, relative
   * to its maximum, is within their tolerance.
   * @param slowness 1/(1−λ) with the contraction λ of the slowest point by
   * itself: changes may decrease by that ratio in the end. 1: not known.
   * @param creep_exponent see Contraction.
   * @param r at the beginning of a period; afterwards at the end of the last.
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
        // max() gives back its first argument if that is nan.
        periods.report(periods.has_memory()
                         ? std::max({contraction.add(change, !is_first),
                                     (slowness - 1.) * change,
                                     periods.return_defect()})
                         : 0.);
      }
  }
} // namespace Crevasse

#endif
