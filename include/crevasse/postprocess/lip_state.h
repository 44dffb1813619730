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

#ifndef crevasse_postprocess_lip_state_h
#define crevasse_postprocess_lip_state_h

#include <crevasse/discretisation/contact_boundary.h>
#include <crevasse/time/evolution.h>

namespace Crevasse
{
  /** The crack lip at one instant, over all ranks. */
  struct LipState
  {
    unsigned int closed_nodes     = 0;  ///< of the free ones
    double       force            = 0.; ///< ∫ pressure, held nodes included
    double       largest_pressure = 0.; ///< g / weight
    double       largest_opening  = 0.; ///< u_N − gap
    double       largest_displacement = 0.; ///< of all nodes of the body
  };

  /** A node is closed where its opening vanishes against the largest
   * displacement; with no displacement at all the lip touches. Collective. */
  template <int dim>
  LipState
  lip_state(const ContactBoundary<dim> &lip, const State &state);
} // namespace Crevasse

#endif
