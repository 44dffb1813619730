// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_postprocess_drift_h
#define crevasse_postprocess_drift_h

#include <crevasse/time/observer.h>
#include <crevasse/time/step_list.h>

namespace Crevasse
{
  /** What the displacement gains over the last period: T β once the stress is
   * periodic (model, §2, unsplit form). */
  class Drift : public Observer
  {
  public:
    explicit Drift(const StepList &steps);

    void
    observe(const Sample &sample) override;

    void
    serialize(StateArchive &archive) override;

    /** q(T n) − q(T (n−1)); constrained entries are zero. After the run. */
    const Vector &
    last_period() const
    {
      return drift;
    }

  private:
    const StepList &steps;
    Vector          start;
    Vector          drift;
  };
} // namespace Crevasse

#endif
