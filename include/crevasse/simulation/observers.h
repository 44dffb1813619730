// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_simulation_observers_h
#define crevasse_simulation_observers_h

#include <crevasse/simulation/workspace.h>
#include <crevasse/time/observer.h>

namespace Crevasse
{
  /** What a run on one mesh writes or prints while it computes and at its end,
   * as far as the scene asks for it. Checkpoints come to know of the tables.
   *
   * @param work must outlive the observers; its start is known. Weight
   * functions are solved for. */
  template <int dim>
  std::vector<std::unique_ptr<Observer>>
  make_observers(Workspace<dim> &work);
} // namespace Crevasse

#endif
