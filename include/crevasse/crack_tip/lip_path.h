// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_crack_tip_lip_path_h
#define crevasse_crack_tip_lip_path_h

#include <crevasse/discretisation/space.h>
#include <crevasse/grid/crack_tip.h>

namespace Crevasse
{
  /**
   * The lips behind a tip with two lips, from node to node as far as they lead
   * away from it and turn by less than 20° at each node: a curve or its
   * polygon. Coordinates are (X, Y) of the tip.
   */
  class LipPath
  {
  public:
    /** Collective. */
    LipPath(const Space<2> &space, const CrackTip &tip);

    /** Whether the path is curved from the tip on, as by second-order cells. */
    bool
    is_curved() const
    {
      return curved;
    }

    /** Length of the crack, to its other end or a kink: also where it leads
     * back or aside, which the path does not. */
    double
    length() const
    {
      return total;
    }

    /** Angle of the first bend, between the tangents on both sides of a node; 0
     * if there is none. Where a polygon stands for a curve, the direction of
     * its tip is wrong by half of it. */
    double
    first_bend() const
    {
      return bend;
    }

    /** Whether a point is a node of the path. */
    bool
    has_node(const dealii::Point<2> &local) const;

    /** Sign of √z at a point of a cell. Fields of straight lips jump on the
     * negative axis: between axis and path they are continued.
     * @param center of the cell. */
    double
    sign_of_root(const dealii::Point<2> &center,
                 const dealii::Point<2> &local) const;

  private:
    std::vector<dealii::Point<2>> nodes; ///< from the tip on
    double                        bend = 0., total = 0.;
    bool                          curved = false;
  };
} // namespace Crevasse

#endif
