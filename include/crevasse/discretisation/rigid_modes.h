// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_discretisation_rigid_modes_h
#define crevasse_discretisation_rigid_modes_h

#include <crevasse/discretisation/space.h>

#include <vector>

namespace Crevasse
{
  /** Translations and infinitesimal rotations: three in the plane, six in
   * space. */
  template <int dim>
  constexpr unsigned int n_rigid_modes = dim *(dim + 1) / 2;

  /** Component @p c at @p x of mode @p m: translations come first, then
   * rotations about axes through the origin. */
  template <int dim>
  double
  rigid_mode(const unsigned int        m,
             const unsigned int        c,
             const dealii::Point<dim> &x);

  /** All modes as displacement vectors, rotations about the middle of the body
   * and of unit size; constraints are left out of account. */
  template <int dim>
  std::vector<Vector>
  rigid_modes(const Space<dim> &space);
} // namespace Crevasse

#endif
