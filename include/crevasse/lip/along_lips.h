// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_lip_along_lips_h
#define crevasse_lip_along_lips_h

#include <crevasse/lip/lip_basis.h>

namespace Crevasse
{
  /** Numbers of all nodes of the lips, lip by lip. In the plane the nodes of a
   * lip follow each other from an end, the one with the smallest x, and beyond
   * a branch from there on; in space they have the order of their numbers. */
  template <int dim>
  std::vector<unsigned int>
  nodes_along_lips(const LipBasis<dim> &basis);
} // namespace Crevasse

#endif
