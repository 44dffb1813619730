// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/state_archive.h>
#include <crevasse/postprocess/drift.h>

namespace Crevasse
{
  Drift::Drift(const StepList &steps)
    : steps(steps)
  {
  }



  void
  Drift::observe(const Sample &sample)
  {
    if (sample.step == 0)
      start = sample.state.displacement;
    else if (sample.step == steps.n_steps())
      {
        drift = sample.state.displacement;
        drift -= start;
        if (sample.secular_flow != nullptr)
          drift.add(steps.period(), sample.secular_flow->velocity);
      }
  }



  void
  Drift::serialize(StateArchive &archive)
  {
    archive.section("drift");
    archive.nodal(start);
  }
} // namespace Crevasse
