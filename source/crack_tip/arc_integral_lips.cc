// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

// What the lips contribute to ArcIntegral.

#include <crevasse/crack_tip/arc_integral.h>

namespace Crevasse
{
  using namespace dealii;

  void
  ArcIntegral::find_contact(const std::array<SquareWeight, 2> &weights)
  {
    const CrackTip &tip = region.tip;
    for (std::size_t i = 0; i < body.lip.nodes.size(); ++i)
      {
        const LipNode<2> &node  = body.lip.nodes[i];
        const Point<2>    local = tip.local(node.point);
        const auto        q     = [&](const SquareWeight &weight) {
          return weight.factor(local[0])[0] * weight.factor(local[1])[0];
        };
        if (local[0] >= 0. || !tip.is_on_curve(local) ||
            std::max(-local[0], std::abs(local[1])) >= weights[0].radius)
          continue;
        const Tensor<1, 2> along = tip.global(turn(local));
        const Tensor<1, 2> normal({-along[1], along[0]});
        const auto         jump_of = [&](const ArcField &field) {
          return normal * ((field.at(local, false).slopes -
                            field.at(local, true).slopes) *
                           along);
        };
        contact.push_back({i,
                           tip.length_to(local),
                           node.normal * normal > 0. ? along : -along,
                           {{q(weights[0]), q(weights[1])}},
                           {{jump_of(units[0]), jump_of(units[1])}}});
      }
  }



  double
  ArcIntegral::add_contact(const Vector        &nodal,
                           const ContactForces &forces,
                           const double         zone,
                           Sums                &sums) const
  {
    double slip = 0.;
    if (region.tip.is_open)
      return slip;
    const auto jumps = body.lip.basis.jumps(nodal);
    for (const ContactNode &node : contact)
      {
        const bool   is_in_zone = node.s <= (1. + 1e-8) * zone;
        const double slides =
          node.along * jumps[body.lip.nodes[node.number].number];
        slip += is_in_zone ? slides : 0.;
        for (const unsigned int w : {0, 1})
          {
            const double force = node.weight[w] * forces.normal[node.number];
            sums[w][0] -= region.tip.curvature * force * slides;
            for (const unsigned int mode : {0, 1})
              sums[w][1 + mode] -= is_in_zone ? 0. : force * node.units[mode];
          }
      }
    return slip;
  }
} // namespace Crevasse
