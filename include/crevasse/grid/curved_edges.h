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
  /** Middle points of curved edges, by the two vertices of an edge, the smaller
   * number first. */
  template <int dim>
  using EdgeMiddles =
    std::map<std::pair<unsigned int, unsigned int>, dealii::Point<dim>>;

  /**
   * Makes edges of a coarse mesh circular arcs. An arc through three points
   * differs from the parabola through them by the fourth power of its angle;
   * divided edges stay on the circle.
   */
  template <int dim>
  void
  set_curved_edges(const EdgeMiddles<dim>     &middles,
                   dealii::Triangulation<dim> &mesh);

  /** Makes an edge that is curved the parabola through its ends and another
   * middle; it must not be divided. */
  void
  set_parabola(const dealii::Triangulation<3>::line_iterator &line,
               const dealii::Point<3>                        &middle,
               dealii::Triangulation<3>                      &mesh);

  /** Projects a point to the circle through three points, unless they lie on a
   * straight line. @throw SceneError as set_curved_edges() does. */
  dealii::Point<3>
  project_to_arc(const dealii::Point<3> &begin,
                 const dealii::Point<3> &end,
                 const dealii::Point<3> &middle,
                 const dealii::Point<3> &point);

  /** Whether a mesh has curved edges. The same on all ranks. */
  template <int dim>
  bool
  has_curved_edges(const dealii::Triangulation<dim> &mesh);

  /** Checks the faces with these ids. @throw SceneError if one is curved. */
  template <int dim>
  void
  require_flat_faces(const dealii::Triangulation<dim>           &mesh,
                     const char                                 *role,
                     const std::set<dealii::types::boundary_id> &ids);
} // namespace Crevasse

#endif
