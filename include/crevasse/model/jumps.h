// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_model_jumps_h
#define crevasse_model_jumps_h

#include <crevasse/model/body.h>
#include <crevasse/parameters/scene.h>
#include <crevasse/time/step_list.h>

#include <vector>

namespace Crevasse
{
  /** The ends of steps at which loads or material jump in time: the end of the
   * period, where t begins anew, and others if formulas can jump. Collective.
   *
   * @param largest_load over all steps, by largest_load(). */
  template <int dim>
  std::vector<double>
  find_jumps(const Scene     &scene,
             const Body<dim> &body,
             const StepList  &steps,
             const double     largest_load);
} // namespace Crevasse

#endif
