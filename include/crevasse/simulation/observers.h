// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_simulation_observers_h
#define crevasse_simulation_observers_h

#include <crevasse/simulation/workspace.h>
#include <crevasse/time/observer.h>

namespace Crevasse
{
  /** Creates the observers that write or print what the scene asks for, during
   * a run on one mesh and at its end. Checkpoints receive the names of tables.
   *
   * @param work must outlive the observers; its start is known. Observers solve
   * for weight functions. */
  template <int dim>
  std::vector<std::unique_ptr<Observer>>
  make_observers(Workspace<dim> &work);
} // namespace Crevasse

#endif
