// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

// What the lips contribute to ArcIntegral.

#include <crevasse/base/collectively.h>
#include <crevasse/crack_tip/arc_integral.h>

#include <algorithm>
#include <map>
#include <set>

namespace Crevasse
{
  using namespace dealii;

  namespace
  {
    /** Node of a lip. */
    struct LipNodeOnArc
    {
      double                  s, X, Y; ///< along the arc, and local
      bool                    is_below;
      types::global_dof_index first; ///< degree of freedom

      template <typename Archive>
      void
      serialize(Archive &archive, const unsigned int)
      {
        archive &s &X &Y &is_below &first;
      }
    };
  } // namespace



  void
  ArcIntegral::find_pairs(const std::array<SquareWeight, 2> &weights)
  {
    const Space<2>                      &space = body.space;
    const CrackTip                      &tip   = region.tip;
    std::vector<LipNodeOnArc>            own;
    std::vector<types::global_dof_index> dofs(
      space.finite_element.n_dofs_per_face());
    for (const auto &cell : owned_cells(space.dof_handler))
      for (const unsigned int f : cell->face_indices())
        if (const auto face = cell->face(f);
            region.overlaps(cell->active_cell_index(), weights[0].radius) &&
            face->at_boundary() && space.roles.is_lip(face->boundary_id()))
          {
            face->get_dof_indices(dofs);
            const Point<2> inside =
              tip.local(points.location[body.points.first_point(cell)]);
            const std::array<Point<2>, 3> nodes{
              {face->vertex(0), face->vertex(1), face->center(true)}};
            for (const unsigned int n : {0, 1, 2})
              if (const Point<2> local = tip.local(nodes[n]);
                  local[0] < 0. && tip.is_on_curve(local))
                own.push_back({tip.length_to(local),
                               local[0],
                               local[1],
                               tip.height(inside) < 0.,
                               dofs[2 * n]});
          }
    std::vector<LipNodeOnArc> all = of_all_ranks(space.communicator(), own);
    std::sort(all.begin(),
              all.end(),
              [](const LipNodeOnArc &a, const LipNodeOnArc &b) {
                return a.s < b.s;
              });
    std::set<types::global_dof_index> known;
    for (std::size_t i = 0; i < all.size(); ++i)
      for (std::size_t j = i + 1; j < all.size(); ++j)
        {
          // Nodes of refined curved cells are found by iteration.
          constexpr double same_place = 1e-5;
          if (all[j].s > (1. + same_place) * all[i].s)
            break;
          if (all[i].is_below == all[j].is_below ||
              !known.insert(all[i].first).second)
            continue;
          const Point<2>     local(all[i].X, all[i].Y);
          const Tensor<1, 2> along = tip.global(turn(local));
          const Tensor<1, 2> normal({-along[1], along[0]});
          const auto         jump_of = [&](const ArcField &field) {
            return normal * ((field.at(local, false).slopes -
                              field.at(local, true).slopes) *
                             along);
          };
          const auto q = [&](const SquareWeight &weight) {
            return weight.factor(local[0])[0] * weight.factor(local[1])[0];
          };
          pairs.push_back({all[i].s,
                           along,
                           {{all[all[i].is_below ? j : i].first,
                             all[all[i].is_below ? i : j].first}},
                           {{q(weights[0]), q(weights[1])}},
                           {{jump_of(units[0]), jump_of(units[1])}}});
        }
    std::map<types::global_dof_index, std::size_t> of_dof;
    for (std::size_t i = 0; i < pairs.size(); ++i)
      for (const auto first : pairs[i].sides)
        of_dof[first] = i;
    for (std::size_t i = 0; i < body.lip.nodes.size(); ++i)
      if (const auto pair = of_dof.find(body.lip.nodes[i].sides[0]);
          pair != of_dof.end())
        contact.emplace_back(i, pair->second);
  }



  ArcIntegral::Jumps
  ArcIntegral::jumps_of(const Vector &nodal) const
  {
    std::vector<double> all(2 * pairs.size());
    for (std::size_t i = 0; i < all.size(); ++i)
      for (const unsigned int side : {0, 1})
        if (const auto first = pairs[i / 2].sides[side];
            nodal.in_local_range(first))
          all[i] += (side == 0 ? 1. : -1.) * nodal(first + i % 2);
    Utilities::MPI::sum(all, body.space.communicator(), all);
    Jumps jumps(pairs.size());
    for (std::size_t i = 0; i < all.size(); ++i)
      jumps[i / 2][i % 2] = all[i];
    return jumps;
  }



  void
  ArcIntegral::add_contact(const Jumps         &jumps,
                           const ContactForces &forces,
                           const double         zone,
                           Sums                &sums) const
  {
    for (const auto &[node, i] : contact)
      for (const unsigned int w : {0, 1})
        {
          const Pair  &pair  = pairs[i];
          const double force = pair.weight[w] * forces.normal[node];
          sums[w][0] -= region.tip.curvature * force * (pair.along * jumps[i]);
          if (pair.s > (1. + 1e-8) * zone)
            for (const unsigned int mode : {0, 1})
              sums[w][1 + mode] -= force * pair.units[mode];
        }
  }
} // namespace Crevasse
