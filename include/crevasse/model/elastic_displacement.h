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

#ifndef crevasse_model_elastic_displacement_h
#define crevasse_model_elastic_displacement_h

#include <crevasse/model/solvers.h>

namespace Crevasse
{
  /** The elastic displacement of a body of constant stiffness under the given
   * loads, with the lip open or held at u_N = 0. What it costs is added to the
   * statistics of the solvers. */
  template <int dim>
  Vector
  elastic_displacement(const Scene     &scene,
                       const Body<dim> &body,
                       Solvers<dim>    &solvers,
                       const Vector    &loads,
                       const bool       lip_closed);
} // namespace Crevasse

#endif
