// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/state_archive.h>
#include <crevasse/periodic/run_state.h>

namespace Crevasse
{
  void
  RunState::serialize(StateArchive &archive)
  {
    archive.section("run");
    archive.common(result.periods);
    archive.common(result.converged);
    archive.common(result.steps_repeat);
    archive.common(result.stress_change);
    archive.common(result.stress_error_estimate);
    archive.common(solvers);
    archive.common(rate_evaluations);
    archive.common(largest_stress);
    archive.common(largest_displacement);
    archive.common(largest_opening);
    archive.common(seconds);
    archive.common(methods_left);
  }
} // namespace Crevasse
