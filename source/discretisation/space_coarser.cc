// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/discretisation/rigid_motions.h>
#include <crevasse/discretisation/space.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <limits>
#include <utility>

namespace Crevasse
{
  using namespace dealii;

  namespace
  {
    /** A vertex with its distance. */
    template <int dim>
    using Candidate = std::pair<double, Point<dim>>;



    /** Nearer; of equally near ones, first in the order of coordinates, so that
     * ranks agree. */
    template <int dim>
    bool
    is_better(const Candidate<dim> &one, const Candidate<dim> &other)
    {
      return one.first < other.first ||
             (one.first == other.first &&
              std::lexicographical_compare(one.second.begin_raw(),
                                           one.second.end_raw(),
                                           other.second.begin_raw(),
                                           other.second.end_raw()));
    }
  } // namespace



  template <int dim>
  std::optional<Point<dim>>
  Space<dim>::nearest_free_vertex(const FixedPoint<dim>         &fixed_point,
                                  const std::vector<Point<dim>> &taken) const
  {
    const auto is_free = [&](const auto &cell, const unsigned int v) {
      for (const Point<dim> &vertex : taken)
        if (cell->vertex(v).distance(vertex) < 1e-8 * cell->diameter())
          return false;
      for (unsigned int d = 0; d < dim; ++d)
        if (fixed_point.components[d] && is_tied(cell->vertex_dof_index(v, d)))
          return false;
      return true;
    };

    constexpr double far = std::numeric_limits<double>::max();
    Candidate<dim>   nearest(far, Point<dim>());
    for (const auto &cell : dofs.active_cell_iterators())
      if (cell->is_locally_owned())
        for (const unsigned int v : cell->vertex_indices())
          {
            const Candidate<dim> candidate(
              cell->vertex(v).distance(fixed_point.point), cell->vertex(v));
            if (is_better<dim>(candidate, nearest) && is_free(cell, v))
              nearest = candidate;
          }
    for (const auto &of_rank :
         Utilities::MPI::all_gather(communicator(), nearest))
      if (is_better<dim>(of_rank, nearest))
        nearest = of_rank;
    if (nearest.first == far)
      return {};
    return nearest.second;
  }



  template <int dim>
  std::vector<FixedPoint<dim>>
  Space<dim>::at_vertices(
    const std::vector<FixedPoint<dim>> &fixed_points) const
  {
    std::vector<FixedPoint<dim>>                   moved;
    std::vector<std::pair<Point<dim>, Point<dim>>> moves;
    for (const FixedPoint<dim> &fixed_point : fixed_points)
      {
        std::vector<Point<dim>> taken; // by other points
        for (const auto &[from, to] : moves)
          if (from != fixed_point.point)
            taken.push_back(to);
        if (const auto vertex = nearest_free_vertex(fixed_point, taken))
          {
            moves.emplace_back(fixed_point.point, *vertex);
            moved.push_back({*vertex, fixed_point.components});
          }
      }
    return moved;
  }



  template <int dim>
  std::shared_ptr<const Space<dim>>
  Space<dim>::on_coarser(std::shared_ptr<const Mesh<dim>> coarser_mesh) const
  {
    const auto make_space = [&](const std::vector<FixedPoint<dim>> &fixed) {
      return std::make_shared<const Space>(
        coarser_mesh, fe.degree, boundary_roles, fixed, volumetric);
    };
    const auto without_supports = make_space({});
    if (supports.empty())
      return without_supports;
    auto coarser = make_space(without_supports->at_vertices(supports));
    return find_free_rigid_motions(*coarser).empty() ? coarser : nullptr;
  }



#define INSTANTIATE(dim)                                              \
  template std::optional<Point<dim>> Space<dim>::nearest_free_vertex( \
    const FixedPoint<dim> &, const std::vector<Point<dim>> &) const;  \
  template std::vector<FixedPoint<dim>> Space<dim>::at_vertices(      \
    const std::vector<FixedPoint<dim>> &) const;                      \
  template std::shared_ptr<const Space<dim>> Space<dim>::on_coarser(  \
    std::shared_ptr<const Mesh<dim>>) const

  INSTANTIATE(2);
  INSTANTIATE(3);

#undef INSTANTIATE
} // namespace Crevasse
