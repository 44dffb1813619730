// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_postprocess_lip_opening_h
#define crevasse_postprocess_lip_opening_h

#include <crevasse/discretisation/contact_boundary.h>

namespace Crevasse
{
  /** Displacement jump at each node of LipBasis: of its first side relative to
   * the other side, or to a rigid plane. Collective.
   * @param displacement Space::nodal_values() */
  template <int dim>
  std::vector<dealii::Tensor<1, dim>>
  lip_jumps(const Space<dim> &space, const Vector &displacement);

  /** Nodal opening of the lips, u_N − gap, or the smaller one where two lips
   * meet. It is in one degree of freedom of each node, as in
   * ContactBoundary::pressure(), with zeros elsewhere. Collective.
   * @param displacement Space::nodal_values() */
  template <int dim>
  Vector
  lip_opening(const Space<dim>           &space,
              const ContactBoundary<dim> &lip,
              const Vector               &displacement);
} // namespace Crevasse

#endif
