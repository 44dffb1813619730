// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_discretisation_node_blocks_h
#define crevasse_discretisation_node_blocks_h

#include <crevasse/discretisation/space.h>

#include <vector>

namespace Crevasse
{
  /** The dofs of each node that this rank owns, in the order of their numbers;
   * the coefficient of each singular function by itself. */
  template <int dim>
  std::vector<std::vector<dealii::types::global_dof_index>>
  node_blocks(const Space<dim> &space);
} // namespace Crevasse

#endif
