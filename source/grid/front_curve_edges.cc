// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

// The parts of FrontCurve for its tangents, and for edges of second order.

#include <crevasse/base/problems.h>
#include <crevasse/base/text.h>
#include <crevasse/grid/curved_edges.h>
#include <crevasse/grid/front_curve.h>

#include <map>
#include <optional>

namespace Crevasse
{
  using namespace dealii;

  namespace
  {
    /** Point of a front; beyond an end, where it is at a right angle to the
     * boundary, its mirror image. */
    Point<3>
    continued(const FrontCurve::Chain &chain, const int i)
    {
      const int n = chain.n_segments();
      if (chain.is_closed)
        return chain.points[(i + n) % n];
      if (i >= 0 && i <= n)
        return chain.points[i];
      const unsigned int  end     = i < 0 ? 0 : n;
      const Tensor<1, 3> &tangent = chain.tangents[end];
      const Tensor<1, 3>  arm = chain.points[2 * end - i] - chain.points[end];
      return chain.points[end] + arm - 2. * (arm * tangent) * tangent;
    }



    /** Unit tangent at a point of the polynomial of the chords' lengths through
     * it and this number of neighbours on both sides. */
    Tensor<1, 3>
    tangent_of_polynomial(const FrontCurve::Chain &chain,
                          const int                i,
                          const int                reach)
    {
      std::vector<Tensor<1, 3>> arms; // from this point
      std::vector<double>       lengths;
      for (const int sign : {-1, 1})
        {
          double length = 0.;
          for (int k = 1; k <= reach; ++k)
            {
              const Point<3> here = continued(chain, i + sign * k);
              length += here.distance(continued(chain, i + sign * (k - 1)));
              arms.push_back(here - chain.points[i]);
              lengths.push_back(sign * length);
            }
        }
      Tensor<1, 3> slope; // Lagrange's formula
      for (std::size_t k = 0; k < arms.size(); ++k)
        {
          double factor = 1. / lengths[k];
          for (std::size_t m = 0; m < arms.size(); ++m)
            if (m != k)
              factor *= lengths[m] / (lengths[m] - lengths[k]);
          slope += factor * arms[k];
        }
      return slope / slope.norm();
    }



    /** Calls f(i, cell, line) for the coarse mesh's edges between the point i
     * of a front and the next but step − 1; of each cell beside them. */
    template <typename Function>
    void
    for_each_edge(const FrontCurve::Chain &chain,
                  const Triangulation<3>  &mesh,
                  const unsigned int       step,
                  const Function          &f)
    {
      for (const auto &cell : mesh.cell_iterators_on_level(0))
        for (const unsigned int l : cell->line_indices())
          for (unsigned int i = 0; i + step < chain.points.size(); ++i)
            {
              const auto      line = cell->line(l);
              const Point<3> &a = chain.points[i], &b = chain.points[i + step];
              if ((line->vertex(0) == a && line->vertex(1) == b) ||
                  (line->vertex(0) == b && line->vertex(1) == a))
                f(i, cell, line);
            }
    }



    /** Middle of the parabola between two points of a front with its tangents
     * there; none where they do not meet between them, as of an edge that bends
     * to both sides. */
    std::optional<Point<3>>
    middle_of_parabola(const FrontCurve::Chain &chain,
                       const unsigned int       begin,
                       const unsigned int       end)
    {
      const Tensor<1, 3> &at_begin = chain.tangents[begin],
                         &at_end   = chain.tangents[end];
      const Tensor<1, 3> chord     = chain.points[end] - chain.points[begin];
      const Tensor<1, 3> turn      = cross_product_3d(at_begin, at_end);
      const double       to_corner =
        cross_product_3d(chord, at_end) * turn / turn.norm_square();
      const Tensor<1, 3> corner = to_corner * at_begin; // from the begin
      if (!(to_corner > 0. && (chord - corner) * at_end > 0.))
        return {};
      return chain.points[begin] + 0.25 * chord + 0.5 * corner;
    }
  } // namespace



  void
  FrontCurve::add_middles(Chain &chain, const Triangulation<3> &mesh)
  {
    std::map<unsigned int, Point<3>> middles; // by segment
    bool                             is_curved = false;
    for_each_edge(chain,
                  mesh,
                  1,
                  [&](const unsigned int i, const auto &, const auto &line) {
                    const Point<3> &a = chain.points[i],
                                   &b = chain.points[i + 1];
                    middles[i]        = line->center(true);
                    is_curved =
                      is_curved || distance_from_edge(middles[i], a, b) >
                                     1e-6 * a.distance(b);
                  });
    if (is_curved)
      for (auto at = middles.rbegin(); at != middles.rend(); ++at)
        chain.points.insert(chain.points.begin() + at->first + 1, at->second);
  }



  Tensor<1, 3>
  FrontCurve::tangent_at_end(const Chain            &chain,
                             const bool              at_begin,
                             const Triangulation<3> &mesh) const
  {
    const unsigned int n = chain.n_segments();
    const Point<3> &end = at_begin ? chain.points.front() : chain.points.back();
    Tensor<1, 3>    chord = at_begin ? chain.points[1] - chain.points[0]
                                     : chain.points[n] - chain.points[n - 1];
    chord /= chord.norm();
    // Tangent of the circle through the last three points.
    const Tensor<1, 3> &inner = chain.tangents[at_begin ? 1 : n - 1];
    const Tensor<1, 3>  tangent =
      n == 1 ? chord : 2. * (chord * inner) * chord - inner;
    Tensor<1, 3> along;
    for (const auto &cell : mesh.cell_iterators_on_level(0))
      for (const unsigned int f : cell->face_indices())
        {
          const auto face   = cell->face(f);
          const auto is_end = [&](const unsigned int v) {
            return face->vertex(v) == end;
          };
          const auto vertices = face->vertex_indices();
          if (!face->at_boundary() ||
              std::none_of(vertices.begin(), vertices.end(), is_end))
            continue;
          Tensor<1, 3> normal =
            cross_product_3d(face->vertex(1) - face->vertex(0),
                             face->vertex(2) - face->vertex(0));
          normal /= normal.norm();
          if (std::abs(normal * chain.inward) > 0.5)
            continue; // face in the crack plane
          constexpr double cos_of_ten_degrees = 0.985;
          if (std::abs(normal * tangent) < cos_of_ten_degrees)
            throw SceneError(
              wanted_by + ": the crack front meets the boundary at " +
              Text::from_point(end) +
              " at an angle other than 90 degrees, where K is not known. Let "
              "the front end at right angles, or turn this off.");
          along = normal * tangent > 0. ? normal : -normal;
        }
    if (along.norm() == 0.)
      throw SceneError(
        wanted_by + ": the crack front ends within the body at " +
        Text::from_point(end) + ". Check the roles of the boundaries.");
    return along;
  }



  void
  FrontCurve::set_tangents(Chain &chain, const Triangulation<3> &mesh) const
  {
    const unsigned int n = chain.n_segments();
    chain.tangents.resize(n + 1);
    for (const int reach : {1, 2})
      {
        for (unsigned int i = chain.is_closed ? 0 : 1; i < n; ++i)
          chain.tangents[i] = tangent_of_polynomial(chain, i, reach);
        if (chain.is_closed)
          chain.tangents[n] = chain.tangents[0];
        else if (reach == 1)
          {
            const Tensor<1, 3> first = tangent_at_end(chain, true, mesh);
            chain.tangents[n]        = tangent_at_end(chain, false, mesh);
            chain.tangents[0]        = first;
          }
      }
  }



  double
  smooth_fronts(Triangulation<3> &mesh, const BoundaryRoles &roles)
  {
    std::optional<FrontCurve> curve;
    try
      {
        curve.emplace(mesh, roles, "");
      }
    catch (const SceneError &)
      {
        return 0.; // K of such fronts is refused where it is asked for
      }
    // Parts of the chord, and of the smallest edge of the cell.
    constexpr double least = 2.5e-4, most = 0.03, most_across = 0.1;
    double           largest = 0.;
    for (const FrontCurve::Chain &chain : curve->chains())
      for_each_edge(
        chain,
        mesh,
        2,
        [&](const unsigned int i, const auto &cell, const auto &line) {
          const auto middle = middle_of_parabola(chain, i, i + 2);
          if (!middle || line->manifold_id() == numbers::flat_manifold_id)
            return;
          const Tensor<1, 3> chord = chain.points[i + 2] - chain.points[i];
          const Tensor<1, 3> shift = *middle - line->center(true);
          const double       move  = shift.norm() / chord.norm();
          const double       across =
            cross_product_3d(shift, chord).norm() / chord.norm();
          if (move < least || move > most ||
              across > most_across * cell->minimum_vertex_distance())
            return;
          set_parabola(line, *middle, mesh);
          largest = std::max(largest, move);
        });
    return largest;
  }
} // namespace Crevasse
