// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_base_vector_h
#define crevasse_base_vector_h

#include <deal.II/lac/la_parallel_vector.h>

namespace Crevasse
{
  /** A field distributed over the ranks: displacements and forces at the
   * unknowns, stresses and strains at quadrature points. */
  using Vector = dealii::LinearAlgebra::distributed::Vector<double>;
} // namespace Crevasse

#endif
