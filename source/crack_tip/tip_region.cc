// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/collectively.h>
#include <crevasse/base/text.h>
#include <crevasse/crack_tip/tip_region.h>
#include <crevasse/discretisation/cell_values.h>
#include <crevasse/discretisation/rigid_modes.h>

#include <algorithm>

namespace Crevasse
{
  using namespace dealii;

  namespace
  {
    double
    square_norm(const Point<2> &local)
    {
      return std::max(std::abs(local[0]), std::abs(local[1]));
    }



    /** Least square norm max(|X|, |Y|) on a segment: the norm is linear between
     * these candidates. */
    double
    distance_of_segment(const Point<2> &a, const Point<2> &b)
    {
      double     least      = std::min(square_norm(a), square_norm(b));
      const auto look_where = [&](const double at_a, const double at_b) {
        if (at_a * at_b < 0.)
          least =
            std::min(least, square_norm(a + at_a / (at_a - at_b) * (b - a)));
      };
      look_where(a[0], b[0]);
      look_where(a[1], b[1]);
      look_where(a[0] - a[1], b[0] - b[1]);
      look_where(a[0] + a[1], b[0] + b[1]);
      return least;
    }
  } // namespace



  PointGeometry::PointGeometry(const Space<2>           &space,
                               const QuadratureField<2> &points)
    : location(points.n_local_points)
    , weight(points.n_local_points)
    , cell(points.n_local_points)
  {
    for_each_point(space,
                   update_quadrature_points | update_JxW_values,
                   [&](const FEValues<2> &values,
                       const unsigned int q,
                       const std::size_t  point) {
                     location[point] = values.quadrature_point(q);
                     weight[point]   = values.JxW(q);
                     cell[point]     = values.get_cell()->active_cell_index();
                   });
  }



  TipRegion::TipRegion(const Space<2> &space,
                       const CrackTip &tip,
                       const bool      bends)
    : SquareRegion(space.communicator(), space.mesh().n_active_cells())
    , tip(tip)
    , path(space, tip)
    , bends(bends)
    , has_axis(space.roles.has_axis)
  {
    measure_cells(space);
    find_boundaries(space);
    if (end < cell_radius * (1. - rounding))
      throw SceneError(
        "[Crack tip]: the cells at the crack tip " +
        Text::from_point(tip.position) + " reach " +
        Text::from_number(cell_radius) +
        " from it, but another boundary begins at " + Text::from_number(end) +
        ". Make these cells smaller ([Geometry] Subdivisions or Refinements, "
        "or [Refinement] Strategy = tip)" +
        (bends || !path.is_curved()
           ? "."
           : "; a curved lip needs [Material] Viscosity = none, and no "
             "[Boundary] Friction coefficient."));
  }



  FrontFrame
  TipRegion::frame(const Point<2> &local) const
  {
    FrontFrame frame;
    frame.X = local[0];
    frame.Y = local[1];
    for (const unsigned int d : {0, 1})
      {
        frame.ahead[d]  = tip.ahead[d];
        frame.inward[d] = tip.inward[d];
      }
    frame.tangent = cross_product_3d(frame.ahead, frame.inward);
    if (has_axis)
      {
        frame.curvature        = tip.ahead[0] / tip.position[0];
        frame.normal_curvature = tip.inward[0] / tip.position[0];
      }
    return frame;
  }



  TipRegion::Uniform
  TipRegion::uniform(const PointGeometry               &points,
                     const PointValues<VoigtMatrix<2>> &matrices,
                     const bool                         by_side) const
  {
    const auto is_below = [&](const std::size_t p) {
      return by_side && tip.height(tip.local(points.location[p])) < 0.;
    };
    std::array<std::optional<VoigtMatrix<2>>, 2> at_tip;
    for (std::size_t p = 0; p < points.cell.size(); ++p)
      if (auto &side = at_tip[is_below(p)];
          !side && reach(points.cell[p]).first == 0.)
        side = matrices[p];

    // All ranks use the matrices of one rank that has the tip.
    const auto of_all = [this](const std::optional<VoigtMatrix<2>> &side) {
      const unsigned int none = Utilities::MPI::n_mpi_processes(communicator);
      const unsigned int root =
        Utilities::MPI::min(side
                              ? Utilities::MPI::this_mpi_process(communicator)
                              : none,
                            communicator);
      return Utilities::MPI::broadcast(communicator,
                                       side.value_or(VoigtMatrix<2>()),
                                       root);
    };
    std::array<VoigtMatrix<2>, 2> own;
    own[0]        = of_all(at_tip[0]);
    own[1]        = by_side ? of_all(at_tip[1]) : own[0];
    double radius = end;
    for (std::size_t p = 0; p < points.cell.size(); ++p)
      if (const VoigtMatrix<2> &side = own[is_below(p)];
          (matrices[p] - side).norm() > rounding * side.norm())
        radius = std::min(radius, reach(points.cell[p]).first);
    radius = Utilities::MPI::min(radius, communicator);
    return {own[0],
            radius < cell_radius * (1. - rounding) ? 0. : radius,
            own[1]};
  }



  double
  TipRegion::square(const double wish, const double most) const
  {
    if (wish > most * (1. + rounding) ||
        (wish > 0. && wish < cell_radius * (1. - rounding)))
      throw SceneError(Text::format(
        "[Crack tip] Radius = %g: must be at most %g, where another boundary "
        "(or for C(t) another material) begins, and at least %g, where the "
        "cells at the "
        "tip end; or 0.",
        wish,
        most,
        cell_radius));
    return aligned_radius(wish > 0. ? wish : most);
  }



  void
  TipRegion::measure_cells(const Space<2> &space)
  {
    const double tiny = rounding * RigidParts<2>(space.mesh()).size();
    for (const auto &cell : space.mesh().active_cell_iterators())
      if (!cell->is_artificial())
        {
          Interval &reach = cells[cell->active_cell_index()];
          for (const unsigned int f : cell->face_indices())
            {
              const Point<2> a = tip.local(cell->face(f)->vertex(0));
              const Point<2> b = tip.local(cell->face(f)->vertex(1));
              reach.first = std::min(reach.first, distance_of_segment(a, b));
              reach.second =
                std::max({reach.second, square_norm(a), square_norm(b)});
            }
          if (reach.first <= tiny)
            {
              reach.first = 0.;
              cell_radius = std::max(cell_radius, reach.second);
            }
        }
    cell_radius = Utilities::MPI::max(cell_radius, communicator);
  }



  void
  TipRegion::find_boundaries(const Space<2> &space)
  {
    end = std::numeric_limits<double>::max();
    for (const auto &cell : owned_cells(space.mesh()))
      for (const unsigned int f : cell->face_indices())
        if (const auto face = cell->face(f); face->at_boundary())
          {
            const Point<2> a      = tip.local(face->vertex(0));
            const Point<2> b      = tip.local(face->vertex(1));
            const auto     id     = face->boundary_id();
            const bool     is_own = a[0] + b[0] > 0.
                                      ? space.roles.symmetry.count(id) > 0
                                      : space.roles.is_lip(id);
            if (!is_own || !is_of_tip(a, b))
              end = std::min(end, distance_of_segment(a, b));
          }
    for (const CrackTip &other : find_crack_tips(space.mesh(), space.roles))
      if (const double distance = square_norm(tip.local(other.position));
          tip.two_lips && distance > 0.)
        end = std::min(end, distance);
    end = Utilities::MPI::min(end, communicator);
  }
} // namespace Crevasse
