// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_crack_tip_nested_fits_h
#define crevasse_crack_tip_nested_fits_h

#include <crevasse/crack_tip/williams_fit.h>
#include <crevasse/time/state.h>

namespace Crevasse
{
  /** From the tip to the last open node of its lip before the first closed one;
   * 0 if the first node is closed; very large if none is. Collective. */
  double
  open_length(const ContactBoundary<2> &lip,
              const CrackTip           &tip,
              const State              &state,
              const MPI_Comm            communicator);



  /** Fits to smaller and smaller discs around the tip, as far as there are
   * data, of which the largest serves that reaches over no closed part of the
   * lip: near its end the pressure is no straight line. */
  class NestedFits
  {
  public:
    /** Collective.
     *
     * @param radius of the largest disc. */
    NestedFits(const PointGeometry      &points,
               const ContactBoundary<2> &lip,
               const TipRegion          &region,
               const double              radius,
               const MPI_Comm            communicator);

    /** The first fit whose disc ends within this length of the lip, or else
     * the smallest; the first if it is 0. */
    const WilliamsFit &
    within(const double open_length) const;

  private:
    std::vector<WilliamsFit> fits;  ///< the largest disc first
    std::vector<double>      radii; ///< of them
  };
} // namespace Crevasse

#endif
