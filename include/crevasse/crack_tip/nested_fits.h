// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_crack_tip_nested_fits_h
#define crevasse_crack_tip_nested_fits_h

#include <crevasse/crack_tip/williams_fit.h>
#include <crevasse/time/state.h>

namespace Crevasse
{
  /** Distance of the tip to the last open node of its lip before the first
   * closed one; 0 if the first is closed; very large if none is. Collective. */
  double
  open_length(const ContactBoundary<2> &lip,
              const CrackTip           &tip,
              const State              &state);



  /** WilliamsFits to smaller and smaller discs around the tip, as far as there
   * are data. The largest disc without a closed part of the lip is used: near
   * the end of contact the pressure is not linear. */
  class NestedFits
  {
  public:
    /** Makes the fits. Collective.
     *
     * @param radius of the largest disc. */
    NestedFits(const PointGeometry      &points,
               const ContactBoundary<2> &lip,
               const TipRegion          &region,
               const double              radius,
               const MPI_Comm            communicator);

    /** First fit whose disc ends within @p open_length of the lip, or the
     * smallest; the first fit if @p open_length is 0. */
    const WilliamsFit &
    within(const double open_length) const;

  private:
    std::vector<WilliamsFit> fits;  ///< fits, largest disc first
    std::vector<double>      radii; ///< radii of the discs
  };
} // namespace Crevasse

#endif
