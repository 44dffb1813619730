// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_postprocess_drift_h
#define crevasse_postprocess_drift_h

#include <crevasse/postprocess/probe.h>
#include <crevasse/postprocess/tables.h>
#include <crevasse/time/observer.h>
#include <crevasse/time/step_list.h>

#include <vector>

namespace Crevasse
{
  /** What the displacement gains over the last period: T β once the stress is
   * periodic (model, §2, unsplit form). */
  template <int dim>
  class Drift : public Observer
  {
  public:
    /** All arguments must outlive this object.
     * @param contact_table null: there is no lip. */
    Drift(const StepList                         &steps,
          const ContactBoundary<dim>             &lip,
          const std::vector<ProbeEvaluator<dim>> &probes,
          const ContactTable<dim>                *contact_table);

    void
    observe(const Sample &sample) override;

    void
    serialize(StateArchive &archive) override;

    /** summary.json "drift": what the displacement has gained over the last
     * period, divided by its length T (length/time): the largest component of
     * any node, the vector at each probe, and how fast the lip closes at a node
     * at most. This is measured, whether the stress is periodic yet or not; the
     * rate β of the secular problem is its limit, which closes no lip. */
    void
    summarise(Summary &summary) override;

    /** q(T n) − q(T (n−1)); constrained entries are zero. After the run. */
    const Vector &
    last_period() const
    {
      return drift;
    }

  private:
    double
    largest_closing(const double accuracy) const;

    const StepList                         &steps;
    const ContactBoundary<dim>             &lip;
    const std::vector<ProbeEvaluator<dim>> &probes;
    const ContactTable<dim>                *contact_table;
    Vector                                  start;
    Vector                                  drift;
  };
} // namespace Crevasse

#endif
