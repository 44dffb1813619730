// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_postprocess_lip_opening_h
#define crevasse_postprocess_lip_opening_h

#include <crevasse/discretisation/contact_boundary.h>

namespace Crevasse
{
  /** Nodal opening of the lips, u_N − gap, the smaller one where two lips meet:
   * in one degree of freedom of each node, as ContactBoundary::pressure(), with
   * zeros elsewhere. Collective.
   * @param displacement Space::nodal_values() */
  template <int dim>
  Vector
  lip_opening(const Space<dim>           &space,
              const ContactBoundary<dim> &lip,
              const Vector               &displacement);
} // namespace Crevasse

#endif
