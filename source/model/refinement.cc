// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/collectively.h>
#include <crevasse/base/problems.h>
#include <crevasse/grid/corner_angles.h>
#include <crevasse/grid/crack_tip.h>
#include <crevasse/model/refinement.h>

#include <deal.II/distributed/cell_data_transfer.templates.h>
#include <deal.II/fe/fe_q.h>

#include <bitset>
#include <set>

namespace Crevasse
{
  using namespace dealii;

  namespace
  {
    /** Marks the vertices of a cell that are on the front. */
    template <int dim>
    std::bitset<GeometryInfo<dim>::vertices_per_cell>
    at_front(const TriaIterator<CellAccessor<dim>> &cell,
             const CrackFront<dim>                 &front)
    {
      const double tolerance = 1e-6 * cell->minimum_vertex_distance();
      std::bitset<GeometryInfo<dim>::vertices_per_cell> vertices;
      for (const auto &[first, last] : front)
        for (const unsigned int v : cell->vertex_indices())
          if (distance_from_edge(cell->vertex(v), first, last) <= tolerance)
            vertices.set(v);
      return vertices;
    }



    /** Kinks of lips in the plane: corners that they turn into the body by more
     * than an angle, where the stress is singular, too. */
    template <int dim>
    CrackFront<dim>
    kinks_of_lips(const Mesh<dim>     &mesh,
                  const BoundaryRoles &roles,
                  const double         least)
    {
      CrackFront<dim> kinks;
      if constexpr (dim == 2)
        {
          constexpr double       half = numbers::PI;
          std::set<unsigned int> on_lips;
          for (const auto &cell : mesh.cell_iterators_on_level(0))
            for (const auto &face : cell->face_iterators())
              if (face->at_boundary() && roles.is_lip(face->boundary_id()))
                for (const unsigned int v : {0, 1})
                  on_lips.insert(face->vertex_index(v));
          for (const auto &[v, angle] : corner_angles(mesh))
            if (on_lips.count(v) > 0 && angle > half + least &&
                angle < 2. * half - 1e-3)
              kinks.emplace_back(mesh.get_vertices()[v],
                                 mesh.get_vertices()[v]);
        }
      return kinks;
    }



    /** Divides all cells with a vertex on the front once. */
    template <int dim>
    void
    refine_front(Mesh<dim>             &mesh,
                 const BoundaryRoles   &roles,
                 const CrackFront<dim> &front)
    {
      for (const auto &cell : owned_cells(mesh))
        if (at_front<dim>(cell, front).any())
          cell->set_refine_flag();
      do
        mesh.execute_coarsening_and_refinement();
      while (flag_unmatched_lips(mesh, roles));
    }



    /** Calls f(cell, face number) for this rank's faces of cracks. */
    template <int dim, typename Function>
    void
    for_each_crack_face(const Mesh<dim>     &mesh,
                        const BoundaryRoles &roles,
                        const Function      &f)
    {
      for (const auto &cell : owned_cells(mesh))
        for (const unsigned int face : cell->face_indices())
          if (cell->at_boundary(face) &&
              roles.crack.count(cell->face(face)->boundary_id()) > 0)
            f(cell, face);
    }
  } // namespace



  template <int dim>
  bool
  flag_unmatched_lips(Mesh<dim> &mesh, const BoundaryRoles &roles)
  {
    if (roles.crack.empty())
      return false;
    std::vector<Point<dim>> centres;
    std::vector<double>     sizes;
    for_each_crack_face(mesh, roles, [&](const auto &cell, const auto face) {
      centres.push_back(cell->face(face)->center());
      sizes.push_back(cell->face(face)->diameter());
    });
    const MPI_Comm communicator = mesh.get_communicator();
    const auto counts = Utilities::MPI::all_gather(communicator, sizes.size());
    centres           = of_all_ranks(communicator, centres);
    sizes             = of_all_ranks(communicator, sizes);
    const auto   partners = find_partners(centres, sizes);
    unsigned int first    = 0; // index of this rank's first face
    for (unsigned int r = 0; r < Utilities::MPI::this_mpi_process(communicator);
         ++r)
      first += counts[r];

    // Parents of faces without partner: a coarser face is opposite to them. The
    // first child stands for all children.
    std::vector<Point<dim>> wholes;
    std::vector<double>     sizes_of_wholes;
    unsigned int            i = first;
    for_each_crack_face(mesh, roles, [&](const auto &cell, const auto face) {
      TriaIterator<CellAccessor<dim>> up = cell;
      const unsigned int child = GeometryInfo<dim>::child_cell_on_face(
        RefinementCase<dim>::isotropic_refinement, face, 0);
      while (partners[i] == i && up->level() > 0 &&
             up->parent()->child(child) == up)
        {
          up = up->parent();
          wholes.push_back(up->face(face)->center());
          sizes_of_wholes.push_back(up->face(face)->diameter());
        }
      ++i;
    });
    wholes          = of_all_ranks(communicator, wholes);
    sizes_of_wholes = of_all_ranks(communicator, sizes_of_wholes);
    const unsigned int        n_wholes = wholes.size();
    std::vector<unsigned int> alone;
    for (i = 0; i < partners.size(); ++i)
      if (partners[i] == i)
        {
          alone.push_back(i);
          wholes.push_back(centres[i]);
          sizes_of_wholes.push_back(sizes[i]);
        }
    const auto        divided = find_partners(wholes, sizes_of_wholes);
    std::vector<bool> is_coarse(partners.size(), false);
    bool              found = false;
    for (unsigned int k = 0; k < alone.size(); ++k)
      if (divided[n_wholes + k] != n_wholes + k)
        found = is_coarse[alone[k]] = true;

    i = first;
    for_each_crack_face(mesh, roles, [&](const auto &cell, const auto) {
      if (is_coarse[i++])
        cell->set_refine_flag();
    });
    return found;
  }



  template <int dim>
  void
  divide_and_predict(Mesh<dim>             &mesh,
                     const CrackFront<dim> &front,
                     const unsigned int     degree,
                     dealii::Vector<float> &squares)
  {
    constexpr unsigned int n_children =
      GeometryInfo<dim>::max_children_per_cell;
    const double smooth   = std::pow(0.5, 2 * degree + dim);
    const double singular = std::pow(0.5, dim - 1);
    // Squared errors of a cell, and of the children that it would have.
    using Values = std::array<float, 1 + n_children>;
    std::vector<Values> values(mesh.n_active_cells());
    for (const auto &cell : owned_cells(mesh))
      {
        const float square      = squares(cell->active_cell_index());
        const auto  is_singular = at_front<dim>(cell, front);
        Values     &mine        = values[cell->active_cell_index()];
        mine[0]                 = square;
        for (unsigned int v = 0; v < n_children; ++v)
          mine[1 + v] = square * (is_singular[v] ? singular : smooth);
      }
    parallel::distributed::CellDataTransfer<dim, dim, std::vector<Values>>
      transfer(
        mesh,
        false,
        [](const auto &, const Values &parent) {
          std::vector<Values> children(n_children);
          for (unsigned int c = 0; c < n_children; ++c)
            children[c][0] = parent[1 + c];
          return children;
        },
        [smooth](const auto &, const std::vector<Values> &children) {
          Values parent{};
          for (const Values &child : children)
            parent[0] += child[0] / (n_children * smooth);
          return parent;
        });
    transfer.prepare_for_coarsening_and_refinement(values);
    mesh.execute_coarsening_and_refinement();
    values.resize(mesh.n_active_cells());
    transfer.unpack(values);
    squares.reinit(mesh.n_active_cells());
    for (const auto &cell : owned_cells(mesh))
      squares(cell->active_cell_index()) = values[cell->active_cell_index()][0];
  }



  template <int dim>
  types::global_dof_index
  count_unknowns(const Mesh<dim> &mesh, const unsigned int degree)
  {
    DoFHandler<dim> dofs(mesh);
    dofs.distribute_dofs(FESystem<dim>(FE_Q<dim>(degree), dim));
    return dofs.n_dofs();
  }



  template <int dim>
  std::shared_ptr<Mesh<dim>>
  graded_mesh(const std::function<std::shared_ptr<Mesh<dim>>()> &make_mesh,
              const BoundaryRoles                               &roles,
              const RefinementParameters                        &parameters,
              const unsigned int                                 degree)
  {
    const std::shared_ptr<Mesh<dim>> mesh  = make_mesh();
    const CrackFront<dim>            front = crack_front<dim>(*mesh, roles);
    const double                     one_degree = numbers::PI / 180.;
    const CrackFront<dim> kinks = kinks_of_lips<dim>(*mesh, roles, one_degree),
                          sharp =
                            kinks_of_lips<dim>(*mesh, roles, 20. * one_degree);
    // The stress at kinks of a few degrees is hardly singular.
    const auto front_at = [&](const unsigned int level) {
      CrackFront<dim> all  = front;
      const auto     &more = level % 2 == 0 ? kinks : sharp;
      all.insert(all.end(), more.begin(), more.end());
      return all;
    };
    if (front.empty())
      throw SceneError(
        "[Refinement] Strategy = tip: the mesh has no crack tip, where a lip "
        "([Boundary] Contact) continues as a plane of symmetry ([Boundary] "
        "Symmetry), or where the lips of a [Boundary] Crack meet; use adaptive "
        "or none, or check the roles of the boundaries.");
    const unsigned int begin = mesh->n_global_levels() - 1;
    if (begin + parameters.cycles > finest_level<dim>)
      throw SceneError(
        "[Refinement] Cycles = " + std::to_string(parameters.cycles) +
        ": must be at most " + std::to_string(finest_level<dim> - begin) +
        " for this mesh; the coordinates of smaller cells are equal to "
        "rounding.");
    unsigned int n_levels =
      parameters.cycles > 0 ? parameters.cycles : finest_level<dim> - begin;
    if (parameters.target_unknowns > 0)
      {
        // Another mesh is tried: a mesh that is too large cannot be undone.
        const std::shared_ptr<Mesh<dim>> trial   = make_mesh();
        const unsigned int               largest = n_levels;
        for (n_levels = 0; n_levels < largest; ++n_levels)
          {
            refine_front(*trial, roles, front_at(n_levels));
            if (count_unknowns(*trial, degree) > parameters.target_unknowns)
              break;
          }
      }
    for (unsigned int level = 0; level < n_levels; ++level)
      refine_front(*mesh, roles, front_at(level));
    return mesh;
  }



#define INSTANTIATE(dim)                                                \
  template decltype(flag_unmatched_lips<dim>) flag_unmatched_lips<dim>; \
  template decltype(divide_and_predict<dim>)  divide_and_predict<dim>;  \
  template decltype(count_unknowns<dim>)      count_unknowns<dim>;      \
  template decltype(graded_mesh<dim>)         graded_mesh<dim>

  INSTANTIATE(2);
  INSTANTIATE(3);

#undef INSTANTIATE
} // namespace Crevasse
