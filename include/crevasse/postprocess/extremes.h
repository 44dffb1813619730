// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_postprocess_extremes_h
#define crevasse_postprocess_extremes_h

#include <crevasse/base/log.h>
#include <crevasse/model/body.h>
#include <crevasse/periodic/run_state.h>
#include <crevasse/time/observer.h>

namespace Crevasse
{
  /** The largest stress, displacement and viscous strain of a run, or of its
   * last period, and what rounding leaves of the stress. */
  template <int dim>
  class Extremes : public Observer
  {
  public:
    /** @param before what the run has seen on other meshes. */
    Extremes(const Body<dim> &body,
             const bool       of_last_period,
             const RunState  &before,
             Log             &log);

    void
    observe(const Sample &sample) override;

    void
    end_of_period(const PeriodReport &report) override;

    void
    serialize(StateArchive &archive) override;

    /** summary.json "extremes", and "stress_rounding" of "certificate": what
     * rounding leaves of the stress at most, relative to its maximum. The
     * stress is K times the small difference of strains that may be large.
     * Warns of displacements that are not small. Collective. */
    void
    summarise(Summary &summary) override;

    double
    largest_stress() const
    {
      return stress;
    }

    /** Of an unknown. */
    double
    largest_displacement() const
    {
      return displacement;
    }

  private:
    double
    stress_rounding() const;

    void
    warn_of_large_displacements() const;

    const Body<dim> &body;
    const bool       of_last_period;
    Log             &log;
    double           stress;
    double           displacement;
    double           viscous_strain = 0.; ///< largest component
  };
} // namespace Crevasse

#endif
