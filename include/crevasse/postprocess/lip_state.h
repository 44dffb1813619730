// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_postprocess_lip_state_h
#define crevasse_postprocess_lip_state_h

#include <crevasse/discretisation/contact_boundary.h>
#include <crevasse/time/state.h>

namespace Crevasse
{
  /** The crack lip at one instant, over all ranks. */
  struct LipState
  {
    unsigned int closed_nodes     = 0;  ///< of the free ones
    double       force            = 0.; ///< ∫ pressure, held nodes included
    double       largest_pressure = 0.; ///< g / weight
    double       largest_opening  = 0.; ///< u_N − gap
  };

  /** ∫ pressure over the nodes of this rank, with the shares of held ones.
   *
   * @param forces of these nodes. */
  template <int dim>
  double
  contact_force(const ContactBoundary<dim> &lip,
                const std::vector<double>  &forces);

  /** A node is closed where its opening vanishes against the largest
   * displacement of the body; with no displacement at all the lip touches.
   * Collective. */
  template <int dim>
  LipState
  lip_state(const ContactBoundary<dim> &lip, const State &state);
} // namespace Crevasse

#endif
