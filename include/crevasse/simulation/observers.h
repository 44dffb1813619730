// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_simulation_observers_h
#define crevasse_simulation_observers_h

#include <crevasse/postprocess/extremes.h>
#include <crevasse/postprocess/tables.h>
#include <crevasse/simulation/workspace.h>

#include <memory>
#include <string>
#include <vector>

namespace Crevasse
{
  /** All that a run on one mesh writes or prints while it computes and at its
   * end; what the scene does not ask for is not there. */
  template <int dim>
  class Observers
  {
  public:
    /** All arguments must outlive this object.
     *
     * @param work whose start is known; weight functions are solved for.
     * @param state after whose periods tables go on. */
    Observers(const RunSetup<dim> &setup,
              Workspace<dim>      &work,
              const RunOutput     &output,
              const RunState      &state);

    const std::vector<Observer *> &
    list() const;

    /** The names of the tables that go on from step to step. */
    const std::vector<std::string> &
    tables() const;

    /** Has each add its part, write its files and print its lines. */
    void
    summarise(Summary &summary);

    /** Adds what the run on the next mesh has to know. */
    void
    export_state(RunState &state) const;

  private:
    template <typename Derived, typename... Arguments>
    Derived *
    add(Arguments &&...arguments);

    /** What follows the lip and its flow; from here on others depend on it. */
    void
    add_drift(const RunSetup<dim> &setup,
              Workspace<dim>      &work,
              const RunState      &state,
              Log                 &log);

    std::vector<std::unique_ptr<Observer>> owned;
    std::vector<Observer *>                all;
    std::vector<std::string>               names_of_tables;

    // Two of them.
    Extremes<dim>     *extremes;
    ContactTable<dim> *contact_table = nullptr;
  };
} // namespace Crevasse

#endif
