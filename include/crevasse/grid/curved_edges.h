// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_grid_curved_edges_h
#define crevasse_grid_curved_edges_h

#include <deal.II/base/point.h>
#include <deal.II/grid/tria.h>

#include <map>
#include <set>
#include <utility>

namespace Crevasse
{
  /** The points in the middle of edges, by the vertices of these, the smaller
   * number first. */
  template <int dim>
  using EdgeMiddles =
    std::map<std::pair<unsigned int, unsigned int>, dealii::Point<dim>>;

  /**
   * Makes edges of a coarse mesh arcs of circles. Three points determine an arc
   * as they determine a parabola, from which it differs by the fourth power of
   * its angle; what is a circle stays one when edges are divided.
   *
   * @throw SceneError if a point lies elsewhere than near the middle of its
   * edge, or if an arc turns by 180 degrees or more.
   */
  template <int dim>
  void
  set_curved_edges(const EdgeMiddles<dim>     &middles,
                   dealii::Triangulation<dim> &mesh);

  /** Whether set_curved_edges() has found any. The same on all ranks. */
  template <int dim>
  bool
  has_curved_edges(const dealii::Triangulation<dim> &mesh);

  /** @throw SceneError if a face with one of the ids is curved. */
  template <int dim>
  void
  require_flat_faces(const dealii::Triangulation<dim>           &mesh,
                     const char                                 *role,
                     const std::set<dealii::types::boundary_id> &ids);
} // namespace Crevasse

#endif
