// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/collectively.h>
#include <crevasse/base/problems.h>
#include <crevasse/base/text.h>
#include <crevasse/crack_tip/front_region.h>

#include <algorithm>
#include <limits>

namespace Crevasse
{
  using namespace dealii;

  namespace
  {
    double
    size_in_tube(const FrontFrame &frame)
    {
      return std::max(std::abs(frame.X), std::abs(frame.Y));
    }



    /** Frames at points of a face that is straight between its vertices. */
    std::vector<FrontFrame>
    frames_of(const FrontCurve                      &curve,
              const Triangulation<3>::face_iterator &face)
    {
      constexpr unsigned int  n = 4;
      std::vector<FrontFrame> frames;
      for (unsigned int i = 0; i <= n; ++i)
        for (unsigned int j = 0; j <= n; ++j)
          {
            const double u = double(i) / n, v = double(j) / n;
            frames.push_back(curve.frame(Point<3>(
              (1. - u) * (1. - v) * face->vertex(0) +
              u * (1. - v) * face->vertex(1) + (1. - u) * v * face->vertex(2) +
              u * v * face->vertex(3))));
          }
      return frames;
    }
  } // namespace



  FrontRegion::FrontRegion(const Space<3> &space, const std::string &wanted_by)
    : SquareRegion(space.communicator(), space.mesh().n_active_cells())
    , curve(space.mesh(), space.roles, wanted_by)
    , wanted_by(wanted_by)
    , distances(space.mesh().n_active_cells())
  {
    find_vertices(space);
    end = std::numeric_limits<double>::max();
    for (const auto &cell : owned_cells(space.mesh()))
      for (const unsigned int f : cell->face_indices())
        if (const auto face = cell->face(f); face->at_boundary())
          {
            const auto frames = frames_of(curve, face);
            if (!is_own_face(space, face, frames))
              for (const FrontFrame &frame : frames)
                end = std::min(end, size_in_tube(frame));
          }
    constexpr double part = 0.5;
    end =
      std::min(part * curve.reach(), Utilities::MPI::min(end, communicator));
    measure_cells(space);
    if (end < 1e-6 * cell_radius)
      throw SceneError(
        wanted_by +
        ": the crack front touches a boundary that is loaded, clamped or "
        "displaced, or a lip of another crack, and the field there is not "
        "known. Let the front end at a free boundary or a plane of symmetry.");
    if (end < cell_radius * (1. - 1e-8))
      throw SceneError(
        wanted_by + ": the cells at the crack front reach " +
        Text::from_number(cell_radius) +
        " from it, but another boundary, or the curvature of the front, limits "
        "the tube to " +
        Text::from_number(end) +
        ". Make these cells smaller, also along the front ([Geometry] "
        "Subdivisions or the mesh file, or [Refinement] Strategy = tip).");
  }



  void
  FrontRegion::find_vertices(const Space<3> &space)
  {
    const std::vector<FrontEdge> edges =
      oriented_crack_front(space.mesh(), space.roles);
    std::vector<Vertex> found;
    double              worst = 0.; // largest distance to the curve / cell
    for (const auto &cell : owned_cells(space.mesh()))
      {
        const unsigned int index  = cell->active_cell_index();
        const double       length = cell->minimum_vertex_distance();
        distances[index]          = curve.frame(cell->center()).distance();
        if (!is_near(cell, 0.))
          continue;
        for (const unsigned int v : cell->vertex_indices())
          {
            const Point<3> &point = cell->vertex(v);
            if (std::none_of(edges.begin(), edges.end(), [&](const auto &edge) {
                  return distance_from_edge(point, edge.first, edge.last) <
                         1e-6 * length;
                }))
              continue;
            const FrontFrame frame = curve.frame(point);
            worst                  = std::max(worst, frame.distance() / length);
            cells[index].first     = 0.;
            const auto faces       = GeometryInfo<3>::vertex_to_face[v];
            const bool is_symmetric =
              std::any_of(std::begin(faces),
                          std::end(faces),
                          [&](const auto f) {
                            return space.roles.symmetry.count(
                                     cell->face(f)->boundary_id()) > 0;
                          });
            found.push_back(
              {point, frame.chain, frame.s, 0., 0., is_symmetric});
          }
        for (const unsigned int v : cell->vertex_indices())
          if (is_at_front(cell))
            cells[index].second =
              std::max(cells[index].second,
                       size_in_tube(curve.frame(cell->vertex(v))));
        cell_radius = std::max(cell_radius, cells[index].second);
      }
    cell_radius           = Utilities::MPI::max(cell_radius, communicator);
    constexpr double much = 0.1;
    if (Utilities::MPI::max(worst, communicator) > much)
      throw SceneError(
        wanted_by +
        ": the crack front is a polygon whose corners the refined mesh "
        "resolves, where K and C(t) are not smooth. Use a finer mesh file and "
        "fewer [Refinement] Cycles or [Geometry] Refinements.");
    found = of_all_ranks(communicator, found);
    number_vertices(found);
  }



  void
  FrontRegion::number_vertices(std::vector<Vertex> &found)
  {
    const auto length = [this](const Vertex &vertex) {
      return curve.chains()[vertex.chain].length();
    };
    constexpr double negligible = 1e-9;
    for (Vertex &vertex : found)
      if (curve.chains()[vertex.chain].is_closed &&
          vertex.s > (1. - negligible) * length(vertex))
        vertex.s = 0.;
    std::sort(found.begin(), found.end(), [](const auto &a, const auto &b) {
      return std::make_pair(a.chain, a.s) < std::make_pair(b.chain, b.s);
    });
    for (const Vertex &vertex : found)
      if (vertices.empty() || vertices.back().chain != vertex.chain ||
          vertex.s - vertices.back().s > negligible * length(vertex))
        vertices.push_back(vertex);
    for (unsigned int begin = 0, next = 0; begin < vertices.size();
         begin = next)
      {
        while (next < vertices.size() &&
               vertices[next].chain == vertices[begin].chain)
          ++next;
        for (unsigned int v = begin + 1; v < next; ++v)
          vertices[v].before = vertices[v - 1].after =
            vertices[v].s - vertices[v - 1].s;
        if (curve.chains()[vertices[begin].chain].is_closed)
          vertices[begin].before = vertices[next - 1].after =
            length(vertices[begin]) - vertices[next - 1].s;
      }
    for (const Vertex &vertex : vertices)
      largest_edge = std::max(largest_edge, vertex.after);
  }



  void
  FrontRegion::measure_cells(const Space<3> &space)
  {
    for (const auto &cell : owned_cells(space.mesh()))
      if (is_near(cell, end) && !is_at_front(cell))
        for (const unsigned int v : cell->vertex_indices())
          {
            Interval    &reach = cells[cell->active_cell_index()];
            const double size  = size_in_tube(curve.frame(cell->vertex(v)));
            reach = {std::min(reach.first, size), std::max(reach.second, size)};
          }
  }



  double
  FrontRegion::tube(const double wish, const double most) const
  {
    // In a much larger tube, steep hats would weight the stress far away.
    constexpr double several = 3., tolerance = 1e-8;
    if (wish == 0.)
      return std::min(most, std::max(several * cell_radius, largest_edge));
    if (wish > most * (1. + tolerance) || wish < cell_radius * (1. - tolerance))
      throw SceneError(
        "[Crack tip] Radius = " + Text::from_number(wish) +
        ": must be at most " + Text::from_number(most) +
        ", where another boundary (or for C(t) another material) begins, or "
        "half the radius of curvature of the front, and at least " +
        Text::from_number(cell_radius) +
        ", where the cells at the front end; or 0.");
    return wish;
  }



  std::array<FrontRegion::Hat, 2>
  FrontRegion::hats(const FrontFrame &frame) const
  {
    const auto after =
      std::upper_bound(vertices.begin(),
                       vertices.end(),
                       std::make_pair(frame.chain, frame.s),
                       [](const auto &place, const Vertex &vertex) {
                         return place < std::make_pair(vertex.chain, vertex.s);
                       });
    // Find the vertex before; the first of its chain has s = 0 to rounding.
    unsigned int i =
      after == vertices.begin() ? 0 : after - vertices.begin() - 1;
    if (vertices[i].chain != frame.chain)
      ++i;
    if (vertices[i].after == 0.)
      --i; // at the end of the front
    unsigned int next = i + 1;
    if (next == vertices.size() || vertices[next].chain != vertices[i].chain)
      for (next = i; next > 0 && vertices[next - 1].chain == vertices[i].chain;)
        --next; // first vertex of closed front
    const double length = vertices[i].after;
    const double part = std::clamp((frame.s - vertices[i].s) / length, 0., 1.);
    return {{{i, 1. - part, -1. / length}, {next, part, 1. / length}}};
  }



  std::vector<double>
  FrontRegion::values_of_means(const std::vector<double> &means) const
  {
    // A mean exceeds the value by h²/12 of the second derivative. Ends on
    // planes of symmetry are like others; at other ends the function is taken
    // as linear.
    std::vector<double>                              values = means;
    std::vector<std::pair<std::size_t, std::size_t>> ends; // and neighbours
    for (std::size_t v = 0, first = 0; v < means.size(); ++v)
      {
        if (vertices[v].chain != vertices[first].chain)
          first = v;
        if (vertices[v].after == 0.)
          continue; // end of an open front
        const bool is_last =
          v + 1 == means.size() || vertices[v + 1].chain != vertices[v].chain;
        const std::size_t next = is_last ? first : v + 1;
        const double      change =
          vertices[v].after / 12. * (means[next] - means[v]);
        values[v] -= change / vertices[v].integral();
        values[next] += change / vertices[next].integral();
        if (vertices[v].is_end() != vertices[next].is_end())
          ends.push_back(vertices[v].is_end() ? std::make_pair(v, next)
                                              : std::make_pair(next, v));
      }
    for (const auto &[last, neighbour] : ends)
      if (!vertices[last].on_symmetry)
        values[last] = 1.5 * means[last] - 0.5 * values[neighbour];
    return values;
  }



  bool
  FrontRegion::is_own_face(const Space<3>                        &space,
                           const Triangulation<3>::face_iterator &face,
                           const std::vector<FrontFrame>         &frames) const
  {
    const double tiny = 1e-6 * face->diameter();
    const auto   id   = face->boundary_id();
    const auto   all  = [&frames](const auto &condition) {
      return std::all_of(frames.begin(), frames.end(), condition);
    };
    const bool is_lip    = space.roles.is_lip(id);
    const bool is_plane  = space.roles.symmetry.count(id) > 0;
    const bool is_loaded = space.roles.loaded.count(id) > 0 ||
                           space.roles.clamped.count(id) > 0 ||
                           space.roles.displaced.count(id) > 0;
    if (all([&](const FrontFrame &f) { return std::abs(f.Y) < tiny; }))
      // With straight edges a face may reach a little beyond the front.
      return frames[frames.size() / 2].X < 0. ? is_lip : is_plane;
    return !is_lip && !is_loaded && all([&](const FrontFrame &f) {
      const auto &chain = curve.chains()[f.chain];
      return !chain.is_closed && (f.s < tiny || f.s > chain.length() - tiny);
    });
  }
} // namespace Crevasse
