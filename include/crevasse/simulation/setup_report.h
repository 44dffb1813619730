// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_simulation_setup_report_h
#define crevasse_simulation_setup_report_h

#include <crevasse/base/log.h>
#include <crevasse/base/summary.h>
#include <crevasse/simulation/run.h>

namespace Crevasse
{
  /** Sizes of a discretised body for summary.json, with "cells_of_ranks" on the
   * first rank. Collective. */
  template <int dim>
  Summary
  sizes_of(const Body<dim> &body);

  /** Lines about settings that are valid, but probably a mistake. */
  template <int dim>
  std::vector<std::string>
  warnings(const Run<dim> &run);

  /** Warnings of tables whose peaks the current steps miss, or whose rows do
   * not have the temperatures seen so far. Collective. */
  template <int dim>
  std::vector<std::string>
  table_warnings(const Run<dim> &run);

  /** Logs effects, sizes, predicted memory and choices. Collective.
   * @throw SceneError if there is not enough memory. */
  template <int dim>
  void
  describe(const Run<dim> &run);
} // namespace Crevasse

#endif
