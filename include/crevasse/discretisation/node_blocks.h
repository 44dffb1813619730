// ---------------------------------------------------------------------
//
// Copyright (C) 2026 by the Crevasse authors
//
// This file is part of Crevasse. It is free software; you can use it,
// redistribute it and/or modify it under the terms of the GNU Lesser
// General Public License as published by the Free Software Foundation;
// either version 2.1 of the License, or (at your option) any later version.
//
// ---------------------------------------------------------------------

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
