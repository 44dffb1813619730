// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/problems.h>
#include <crevasse/discretisation/crack_tip.h>
#include <crevasse/discretisation/refinement.h>

#include <deal.II/base/mpi.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_system.h>

#include <algorithm>
#include <iterator>
#include <set>
#include <string>

namespace Crevasse
{
  using namespace dealii;

  namespace
  {
    /** The edges of the coarse mesh that belong both to a face with one of
     * these ids and to one with one of those. */
    std::set<unsigned int>
    edges_between(const Mesh<3>                      &mesh,
                  const std::set<types::boundary_id> &these,
                  const std::set<types::boundary_id> &those)
    {
      const auto edges_of = [&mesh](const std::set<types::boundary_id> &ids) {
        std::set<unsigned int> edges;
        for (const auto &cell : mesh.cell_iterators_on_level(0))
          for (const auto &face : cell->face_iterators())
            if (face->at_boundary() && ids.count(face->boundary_id()) > 0)
              for (const unsigned int line : face->line_indices())
                edges.insert(face->line_index(line));
        return edges;
      };
      const std::set<unsigned int> some   = edges_of(these),
                                   others = edges_of(those);
      std::set<unsigned int> common;
      std::set_intersection(some.begin(),
                            some.end(),
                            others.begin(),
                            others.end(),
                            std::inserter(common, common.begin()));
      return common;
    }



    /** Edges of a mesh in space whose ends are both on the front. */
    std::vector<std::pair<Point<3>, Point<3>>>
    edges_of_front(const Mesh<3>               &mesh,
                   const BoundaryRoles         &roles,
                   const std::vector<Point<3>> &vertices)
    {
      const std::set<unsigned int> candidates =
        edges_between(mesh, roles.contact, roles.symmetry);
      const auto on_front = [&vertices](const Point<3> &point) {
        return std::find(vertices.begin(), vertices.end(), point) !=
               vertices.end();
      };
      std::set<unsigned int>                     found;
      std::vector<std::pair<Point<3>, Point<3>>> edges;
      for (const auto &cell : mesh.cell_iterators_on_level(0))
        for (const unsigned int l : cell->line_indices())
          {
            const auto line = cell->line(l);
            if (candidates.count(line->index()) > 0 &&
                on_front(line->vertex(0)) && on_front(line->vertex(1)) &&
                found.insert(line->index()).second)
              edges.emplace_back(line->vertex(0), line->vertex(1));
          }
      return edges;
    }



    template <int dim>
    double
    distance(const Point<dim>                        &point,
             const std::pair<Point<dim>, Point<dim>> &edge)
    {
      const Tensor<1, dim> along  = edge.second - edge.first;
      const double         square = along.norm_square();
      const double         where =
        square == 0. ? 0. : (point - edge.first) * along / square;
      return point.distance(edge.first + std::clamp(where, 0., 1.) * along);
    }



    template <int dim>
    void
    require_front(const CrackFront<dim> &front)
    {
      if (front.empty())
        throw SceneError(
          "[Refinement] Strategy = tip: the mesh has no crack tip, where "
          "faces of the lip ([Boundary] Contact) go straight on as faces of a "
          "plane of symmetry; use adaptive or none, or look at the roles of "
          "the boundaries.");
    }
  } // namespace



  template <int dim>
  types::global_dof_index
  count_unknowns(const Mesh<dim> &mesh, const unsigned int degree)
  {
    DoFHandler<dim> dofs(mesh);
    dofs.distribute_dofs(FESystem<dim>(FE_Q<dim>(degree), dim));
    return dofs.n_dofs();
  }



  template <int dim>
  void
  require_affordable(const Mesh<dim>            &mesh,
                     const RefinementParameters &parameters,
                     const unsigned int          degree)
  {
    const types::global_dof_index n_unknowns = count_unknowns(mesh, degree);
    if (parameters.target_unknowns > 0 &&
        n_unknowns > parameters.target_unknowns)
      throw SceneError(
        "[Refinement] Target unknowns = " +
        std::to_string(parameters.target_unknowns) + ": the mesh has " +
        std::to_string(n_unknowns) +
        " before its first refinement; raise it, or begin with a coarser mesh "
        "([Geometry] Subdivisions and Refinements).");
  }



  template <int dim>
  CrackFront<dim>::CrackFront(const Mesh<dim> &mesh, const BoundaryRoles &roles)
  {
    const std::vector<Point> vertices = crack_front<dim>(mesh, roles);
    if constexpr (dim == 2)
      for (const Point &vertex : vertices)
        edges.emplace_back(vertex, vertex);
    else
      edges = edges_of_front(mesh, roles, vertices);
  }



  template <int dim>
  bool
  CrackFront<dim>::empty() const
  {
    return edges.empty();
  }



  template <int dim>
  bool
  CrackFront<dim>::touches(const typename Mesh<dim>::cell_iterator &cell) const
  {
    const double tolerance = 1e-6 * cell->minimum_vertex_distance();
    for (const auto &edge : edges)
      for (const unsigned int v : cell->vertex_indices())
        if (distance<dim>(cell->vertex(v), edge) <= tolerance)
          return true;
    return false;
  }



  template <int dim>
  void
  refine_front(Mesh<dim> &mesh, const CrackFront<dim> &front)
  {
    for (const auto &cell : mesh.active_cell_iterators())
      if (cell->is_locally_owned() && front.touches(cell))
        cell->set_refine_flag();
    mesh.execute_coarsening_and_refinement();
  }



  namespace
  {
    /** How many levels there may be before the mesh has too many unknowns. */
    template <int dim>
    unsigned int
    affordable_levels(Mesh<dim>                  &trial,
                      const CrackFront<dim>      &front,
                      const RefinementParameters &parameters,
                      const unsigned int          degree,
                      const unsigned int          largest)
    {
      const auto fits = [&]() {
        return count_unknowns(trial, degree) <= parameters.target_unknowns;
      };
      require_affordable(trial, parameters, degree);
      unsigned int n_levels = 0;
      for (; n_levels < largest; ++n_levels)
        {
          refine_front(trial, front);
          if (!fits())
            break;
        }
      return n_levels;
    }
  } // namespace



  template <int dim>
  std::shared_ptr<Mesh<dim>>
  graded_mesh(const std::function<std::shared_ptr<Mesh<dim>>()> &make_mesh,
              const BoundaryRoles                               &roles,
              const RefinementParameters                        &parameters,
              const unsigned int                                 degree)
  {
    const std::shared_ptr<Mesh<dim>> mesh = make_mesh();
    const CrackFront<dim>            front(*mesh, roles);
    require_front(front);

    const unsigned int begin = mesh->n_global_levels() - 1;
    if (begin + parameters.cycles > finest_level<dim>)
      throw SceneError(
        "[Refinement] Cycles = " + std::to_string(parameters.cycles) +
        ": must be at most " + std::to_string(finest_level<dim> - begin) +
        " here; smaller cells have no coordinates of their own.");
    unsigned int n_levels =
      parameters.cycles > 0 ? parameters.cycles : finest_level<dim> - begin;
    if (parameters.target_unknowns > 0)
      // On another mesh: there is no way back from too large a one.
      n_levels =
        affordable_levels(*make_mesh(), front, parameters, degree, n_levels);
    for (unsigned int level = 0; level < n_levels; ++level)
      refine_front(*mesh, front);
    return mesh;
  }



#define INSTANTIATE(dim)                                                                 \
  template types::global_dof_index count_unknowns<dim>(const Mesh<dim> &,                \
                                                       const unsigned int);              \
  template void                    require_affordable<dim>(const Mesh<dim> &,            \
                                        const RefinementParameters &, \
                                        const unsigned int);          \
  template class CrackFront<dim>;                                                        \
  template void refine_front<dim>(Mesh<dim> &, const CrackFront<dim> &);                 \
  template std::shared_ptr<Mesh<dim>> graded_mesh<dim>(                                  \
    const std::function<std::shared_ptr<Mesh<dim>>()> &,                                 \
    const BoundaryRoles &,                                                               \
    const RefinementParameters &,                                                        \
    const unsigned int)

  INSTANTIATE(2);
  INSTANTIATE(3);

#undef INSTANTIATE
} // namespace Crevasse
