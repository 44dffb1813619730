// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/crack_tip/nested_fits.h>

#include <algorithm>

namespace Crevasse
{
  using namespace dealii;

  double
  open_length(const ContactBoundary<2> &lip,
              const CrackTip           &tip,
              const State              &state)
  {
    constexpr double never = std::numeric_limits<double>::max();
    const auto states = lip.states(state.displacement, state.contact_forces);
    // Distance from the tip to each node of its lip, and whether it is closed.
    std::vector<std::pair<double, bool>> nodes;
    for (std::size_t i = 0; i < states.size(); ++i)
      if (const auto &node = lip.basis.nodes[i]; node.has_unknown())
        if (const Point<2> local = tip.local(node.point);
            local[0] < 0. && tip.is_on_line(local))
          nodes.emplace_back(-local[0], states[i].is_closed);

    double closed = never, open = 0.;
    for (const auto &[distance, is_closed] : nodes)
      if (is_closed)
        closed = std::min(closed, distance);
    for (const auto &[distance, is_closed] : nodes)
      if (distance < closed)
        open = std::max(open, distance);
    return closed == never ? never : open;
  }



  NestedFits::NestedFits(const PointGeometry      &points,
                         const ContactBoundary<2> &lip,
                         const TipRegion          &region,
                         const double              radius,
                         const MPI_Comm            communicator)
  {
    // Each fit also uses a disc of half its radius, which needs data.
    const double least =
      2. * WilliamsFit::least_radius(points, region, communicator);
    constexpr double closer = 0.7;
    double           next   = radius;
    do
      {
        fits.emplace_back(points, lip, region, next, communicator);
        radii.push_back(next);
        next *= closer;
    } while (next >= least);
  }



  const WilliamsFit &
  NestedFits::within(const double open_length) const
  {
    for (std::size_t i = 0; i < fits.size(); ++i)
      if (radii[i] <= open_length)
        return fits[i];
    return open_length > 0. ? fits.back() : fits.front();
  }
} // namespace Crevasse
