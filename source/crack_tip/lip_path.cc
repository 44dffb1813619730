// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/collectively.h>
#include <crevasse/crack_tip/lip_path.h>
#include <crevasse/discretisation/cell_values.h>

namespace Crevasse
{
  using namespace dealii;

  namespace
  {
    /** Part of a face by which nodes of both lips may differ: those of refined
     * curved cells are found by iteration. */
    constexpr double same_place = 1e-5;

    /** Begin, middle and end of a face. */
    using Arc = std::array<Point<2>, 3>;

    Tensor<1, 2>
    unit(const Tensor<1, 2> &v)
    {
      return v / v.norm();
    }



    /** Direction at the begin of an arc of a circle: its angle with the chord
     * to the middle is that of this chord with the chord to the end. */
    Tensor<1, 2>
    tangent(const Point<2> &begin, const Point<2> &middle, const Point<2> &end)
    {
      const Tensor<1, 2> half = unit(middle - begin), all = unit(end - begin);
      return 2. * (half * all) * half - all;
    }



    std::vector<Arc>
    faces_of_lips(const Space<2> &space, const CrackTip &tip)
    {
      std::vector<Arc> faces;
      for (const auto &cell : owned_cells(space.mesh()))
        for (const unsigned int f : cell->face_indices())
          if (const auto face = cell->face(f);
              face->at_boundary() && space.roles.is_lip(face->boundary_id()))
            {
              const Arc arc = {{tip.local(face->vertex(0)),
                                tip.local(face->center(true)),
                                tip.local(face->vertex(1))}};
              faces.push_back(arc);
              faces.push_back({{arc[2], arc[1], arc[0]}});
            }
      return of_all_ranks(space.communicator(), faces);
    }
  } // namespace



  LipPath::LipPath(const Space<2> &space, const CrackTip &tip)
    : nodes(1)
  {
    if (!tip.two_lips)
      return;
    constexpr double       cosine = 0.94; // of 20°
    const std::vector<Arc> faces  = faces_of_lips(space, tip);
    Tensor<1, 2>           direction({-1., 0.});
    Point<2>               begin;
    bool                   is_path = true, goes_on = true;
    for (unsigned int n = 0; goes_on && n < faces.size(); ++n)
      {
        goes_on = false;
        for (const auto &[a, middle, b] : faces)
          {
            const double       tiny = same_place * a.distance(b);
            const Tensor<1, 2> next = tangent(a, middle, b);
            if (a.distance(begin) > tiny || next * direction < cosine)
              continue;
            // Lips that lead back, or aside, end the path, not the crack.
            is_path = is_path && b[0] < begin[0] - tiny &&
                      std::abs(b[1]) <= 0.7 * std::abs(b[0]);
            if (const double turned =
                  std::abs(cross_product_2d(next) * direction);
                turned > same_place && bend == 0. && is_path)
              bend = turned;
            curved    = curved || (nodes.size() == 1 && !tip.is_on_line(b));
            direction = -tangent(b, middle, a);
            // Both halves of an arc are longer than it by a third of what they
            // are longer than its chord.
            total +=
              (4. * (a.distance(middle) + middle.distance(b)) - a.distance(b)) /
              3.;
            if (is_path)
              nodes.push_back(b);
            begin   = b;
            goes_on = true;
            break;
          }
      }
  }



  bool
  LipPath::has_node(const Point<2> &local) const
  {
    for (unsigned int i = 0; nodes.size() > 1 && i < nodes.size(); ++i)
      if (const double size = nodes[i == 0 ? i + 1 : i].norm();
          nodes[i].distance(local) <= same_place * size)
        return true;
    return false;
  }



  double
  LipPath::sign_of_root(const Point<2> &center, const Point<2> &local) const
  {
    if (!curved || local[0] >= 0.)
      return 1.;
    double least = std::numeric_limits<double>::max(), side = 1.;
    for (unsigned int i = 1; i < nodes.size(); ++i)
      {
        const Tensor<1, 2> along = nodes[i] - nodes[i - 1];
        const Tensor<1, 2> to    = center - nodes[i - 1];
        const double       part =
          std::clamp(along * to / along.norm_square(), 0., 1.);
        if (const double distance = (to - part * along).norm();
            distance < least)
          {
            least = distance;
            side  = -(along[0] * to[1] - along[1] * to[0]);
          }
      }
    return std::signbit(side) == std::signbit(local[1]) ? 1. : -1.;
  }
} // namespace Crevasse
