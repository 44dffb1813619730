// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/problems.h>
#include <crevasse/base/text.h>
#include <crevasse/grid/front_curve.h>

#include <deal.II/base/quadrature_lib.h>

#include <algorithm>
#include <limits>

namespace Crevasse
{
  using namespace dealii;

  namespace
  {
    /** A cubic polynomial of u ∈ [0,1], with its derivatives. */
    struct Segment
    {
      Point<3>     begin, end;
      Tensor<1, 3> slope_begin, slope_end;

      /** Chooses the end slopes that approximate a circle best. */
      Segment(const FrontCurve::Chain &chain, const unsigned int i)
        : begin(chain.points[i])
        , end(chain.points[i + 1])
      {
        const auto  &a = chain.tangents[i], &b = chain.tangents[i + 1];
        const double half = std::sqrt(std::max(0., 0.5 * (1. + a * b)));
        const double size = 2. * begin.distance(end) / (1. + half);
        slope_begin       = size * a;
        slope_end         = size * b;
      }

      Point<3>
      value(const double u) const
      {
        const double v = 1. - u;
        return Point<3>(begin + u * u * (3. - 2. * u) * (end - begin) +
                        u * v * (v * slope_begin - u * slope_end));
      }

      Tensor<1, 3>
      slope(const double u) const
      {
        const double v = 1. - u;
        return 6. * u * v * (end - begin) + v * (v - 2. * u) * slope_begin +
               u * (u - 2. * v) * slope_end;
      }

      Tensor<1, 3>
      second(const double u) const
      {
        return 6. * (1. - 2. * u) * (end - begin) +
               (6. * u - 4.) * slope_begin + (6. * u - 2.) * slope_end;
      }

      double
      length(const double u) const
      {
        static const QGauss<1> rule(8);
        double                 sum = 0.;
        for (unsigned int q = 0; q < rule.size(); ++q)
          sum += u * rule.weight(q) * slope(u * rule.point(q)[0]).norm();
        return sum;
      }

      /** Parameter u of the point nearest to @p point, by Newton's method; in
       * [0,1]. */
      double
      nearest(const Point<3> &point) const
      {
        double u =
          (point - begin) * (end - begin) / (end - begin).norm_square();
        for (unsigned int k = 0; k < 8; ++k)
          {
            u                       = std::clamp(u, -0.2, 1.2);
            const Tensor<1, 3> away = value(u) - point, c = slope(u);
            const double       step = away * c / (c * c + away * second(u));
            u -= step;
            if (std::abs(step) < 1e-14)
              break;
          }
        return std::clamp(u, 0., 1.);
      }
    };
  } // namespace



  FrontCurve::FrontCurve(const Triangulation<3> &mesh,
                         const BoundaryRoles    &roles,
                         const std::string      &wanted_by)
    : wanted_by(wanted_by)
  {
    const std::vector<FrontEdge> edges = oriented_crack_front(mesh, roles);
    if (edges.empty())
      throw SceneError(wanted_by +
                       ": the mesh has no crack front, where a lip ([Boundary] "
                       "Contact) continues as a plane of symmetry ([Boundary] "
                       "Symmetry), or where the lips of a [Boundary] Crack "
                       "meet. Give the body a crack, or turn this off.");
    two_lips = edges.front().two_lips;
    for (const FrontEdge &edge : edges)
      if (edge.two_lips != two_lips)
        throw SceneError(wanted_by + ": the crack at " +
                         Text::from_point(edge.first) + " has " +
                         (two_lips ? "one lip, others have two."
                                   : "two lips, others have one.") +
                         " Model both lips of all cracks, or turn this off.");
    join(edges);
    for (Chain &chain : all)
      {
        add_middles(chain, mesh);
        set_tangents(chain, mesh);
        chain.arcs = {0.};
        for (unsigned int i = 0; i < chain.n_segments(); ++i)
          chain.arcs.push_back(chain.arcs.back() +
                               Segment(chain, i).length(1.));
      }
  }



  void
  FrontCurve::join(const std::vector<FrontEdge> &edges)
  {
    const auto error = [this](const Point<3> &place, const std::string &what) {
      return SceneError(wanted_by + ": the crack front " + what + " at " +
                        Text::from_point(place) +
                        ", where K is not known. Turn this off.");
    };
    std::vector<FrontEdge> left  = edges;
    const auto             begin = [&left]() { // open fronts first
      return std::find_if(left.begin(), left.end(), [&](const auto &edge) {
        return std::none_of(left.begin(), left.end(), [&](const auto &before) {
          return before.last == edge.first;
        });
      });
    };
    while (!left.empty())
      {
        auto  next   = begin() == left.end() ? left.begin() : begin();
        Chain chain  = {};
        chain.inward = next->inward;
        chain.points = {next->first};
        while (next != left.end())
          {
            if (next->inward * chain.inward < 1. - 1e-8)
              throw error(next->first, "leaves its plane");
            chain.points.push_back(next->last);
            left.erase(next);
            const auto follows = [&chain](const FrontEdge &edge) {
              return edge.first == chain.points.back();
            };
            if (std::count_if(left.begin(), left.end(), follows) > 1)
              throw error(chain.points.back(), "branches");
            next = std::find_if(left.begin(), left.end(), follows);
          }
        chain.is_closed = chain.points.back() == chain.points.front();
        all.push_back(chain);
      }
  }



  FrontFrame
  FrontCurve::frame(const Point<3> &point) const
  {
    FrontFrame best;
    double     least = std::numeric_limits<double>::max();
    for (unsigned int c = 0; c < all.size(); ++c)
      {
        const Chain       &chain  = all[c];
        const double       Y      = (point - chain.points[0]) * chain.inward;
        const Point<3>     foot   = point - Y * chain.inward;
        const unsigned int n      = chain.n_segments();
        unsigned int       vertex = 0;
        double             square = std::numeric_limits<double>::max();
        for (unsigned int i = 0; i <= n; ++i)
          if (const double here = foot.distance_square(chain.points[i]);
              here < square)
            {
              square = here;
              vertex = i;
            }
        for (const unsigned int end : {0, 1})
          {
            const unsigned int i =
              chain.is_closed
                ? (vertex + n - end) % n
                : std::min(vertex - (vertex > 0 ? end : 0), n - 1);
            const Segment      segment(chain, i);
            const double       u    = segment.nearest(foot);
            const Tensor<1, 3> away = foot - segment.value(u);
            if (const double distance = std::hypot(away.norm(), Y);
                distance < least)
              {
                least              = distance;
                const auto   slope = segment.slope(u);
                const double size  = slope.norm();
                best.chain         = c;
                best.s             = chain.arcs[i] + segment.length(u);
                best.inward        = chain.inward;
                best.tangent       = slope / size;
                best.ahead = cross_product_3d(best.inward, best.tangent);
                best.curvature =
                  -(segment.second(u) * best.ahead) / (size * size);
                best.X = away * best.ahead;
                best.Y = Y;
              }
          }
      }
    return best;
  }



  double
  FrontCurve::reach() const
  {
    double least = std::numeric_limits<double>::max();
    for (const Chain &chain : all)
      for (unsigned int i = 0; i <= chain.n_segments(); ++i)
        for (const Chain &other : all)
          for (const Point<3> &point : other.points)
            {
              // Radius of the circle tangent here and through the other point.
              const Tensor<1, 3> way = point - chain.points[i];
              const Tensor<1, 3> across =
                way - (way * chain.tangents[i]) * chain.tangents[i];
              if (across.norm() > 1e-8 * way.norm())
                least =
                  std::min(least, way.norm_square() / (2. * across.norm()));
            }
    return least;
  }
} // namespace Crevasse
