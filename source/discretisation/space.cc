// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/collectively.h>
#include <crevasse/base/problems.h>
#include <crevasse/base/text.h>
#include <crevasse/discretisation/space.h>

#include <deal.II/base/mpi.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/numerics/vector_tools.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

namespace Crevasse
{
  using namespace dealii;

  template <int dim>
  Space<dim>::Space(std::shared_ptr<const Mesh<dim>>    mesh,
                    const unsigned int                  degree,
                    const BoundaryRoles                &roles,
                    const std::vector<FixedPoint<dim>> &fixed_points,
                    const VolumetricStrain              volumetric_strain,
                    const SingularFunctions            &singular_functions)
    : triangulation(std::move(mesh))
    , fe(FE_Q<dim>(degree), dim)
    , face_rule(singular_functions.fields.empty() ? degree + 1 : 5)
    , boundary_roles(roles)
    , supports(fixed_points)
    , volumetric(volumetric_strain)
    , dofs(*triangulation)
  {
    Assert(degree == 1 || volumetric == VolumetricStrain::full,
           ExcMessage("Mean dilatation is for linear elements."));
    check_roles();
    dofs.distribute_dofs(fe);
    if constexpr (dim == 2)
      if (!singular_functions.fields.empty())
        shapes = std::make_unique<SingularShapes>(singular_functions,
                                                  q1_mapping,
                                                  dofs);
    number_unknowns();
    choose_rules();
    make_constraints();
  }



  template <int dim>
  void
  Space<dim>::check_roles() const
  {
    const std::vector<types::boundary_id> existing =
      triangulation->get_boundary_ids();
    std::ostringstream list;
    for (const auto id : existing)
      list << ' ' << id;

    Problems   problems;
    const auto check = [&](const char                         *role,
                           const std::set<types::boundary_id> &ids) {
      for (const auto id : ids)
        if (std::find(existing.begin(), existing.end(), id) == existing.end())
          problems.add("Boundary",
                       role,
                       std::to_string(id),
                       "no face of the mesh has this boundary id; there are:" +
                         list.str());
    };
    check("Clamped", boundary_roles.clamped);
    check("Symmetry", boundary_roles.symmetry);
    check("Loaded", boundary_roles.loaded);
    check("Contact", boundary_roles.contact);
    problems.throw_if_any();
  }



  template <int dim>
  void
  Space<dim>::number_unknowns()
  {
    const types::global_dof_index n_singular =
      shapes == nullptr ? 0 : shapes->size();
    const auto extended = [&](const IndexSet &of_nodes, const bool with_last) {
      IndexSet all(n_unknowns());
      all.add_indices(of_nodes);
      if (with_last)
        all.add_range(n_unknowns() - n_singular, n_unknowns());
      all.compress();
      return all;
    };
    IndexSet relevant;
    DoFTools::extract_locally_relevant_dofs(dofs, relevant);
    relevant_unknowns = extended(relevant, true);
    owned_unknowns =
      extended(dofs.locally_owned_dofs(),
               Utilities::MPI::this_mpi_process(communicator()) + 1 ==
                 Utilities::MPI::n_mpi_processes(communicator()));
  }



  template <int dim>
  void
  Space<dim>::choose_rules()
  {
    if (shapes == nullptr)
      {
        rules.push_back(QGauss<dim>(fe.degree + 1));
        return;
      }
    rules.push_back(QGauss<dim>(fe.degree + 2));
    if constexpr (dim == 2)
      {
        // As Mousavi and Sukumar (Comput. Mech. 45, 2010) for stresses with
        // 1/√r.
        constexpr unsigned int n         = 5;
        constexpr double       beta      = 2.;
        constexpr double       near_size = 3.5;
        rules.push_back(QGauss<dim>(n));
        for (const unsigned int v : GeometryInfo<dim>::vertex_indices())
          rules.push_back(QSplit<dim>(QDuffy(n, beta),
                                      GeometryInfo<dim>::unit_cell_vertex(v)));

        const Point<dim> &tip = shapes->functions().tip.position;
        rule_of_cell.assign(triangulation->n_active_cells(), 0);
        for (const auto &cell : triangulation->active_cell_iterators())
          {
            const double size = cell->diameter() / std::sqrt(2.);
            auto        &rule = rule_of_cell[cell->active_cell_index()];
            if (cell->center().distance(tip) < near_size * size)
              rule = 1;
            for (const unsigned int v : cell->vertex_indices())
              if (cell->vertex(v).distance(tip) < 1e-8 * size)
                rule = 2 + v;
          }
      }
  }



  template <int dim>
  void
  Space<dim>::make_constraints()
  {
    affine_constraints.reinit(relevant_unknowns);

    DoFTools::make_hanging_node_constraints(dofs, affine_constraints);
    for (const auto id : boundary_roles.clamped)
      VectorTools::interpolate_boundary_values(q1_mapping,
                                               dofs,
                                               id,
                                               Functions::ZeroFunction<dim>(
                                                 dim),
                                               affine_constraints);
    if (!boundary_roles.symmetry.empty())
      VectorTools::compute_no_normal_flux_constraints(
        dofs, 0, boundary_roles.symmetry, affine_constraints, q1_mapping);
    for (const FixedPoint<dim> &fixed_point : supports)
      constrain(fixed_point);
    // Without a lip there is none that it could open.
    if (shapes != nullptr && boundary_roles.contact.empty())
      affine_constraints.add_line(singular_unknown(0));
    affine_constraints.close();
  }



  template <int dim>
  void
  Space<dim>::constrain(const FixedPoint<dim> &fixed_point)
  {
    double     nearest_distance = std::numeric_limits<double>::max();
    Point<dim> nearest;
    bool       found = false;
    collectively(communicator(), [&]() {
      for (const auto &cell : dofs.active_cell_iterators())
        if (!cell->is_artificial())
          for (const unsigned int v : cell->vertex_indices())
            {
              const double distance =
                cell->vertex(v).distance(fixed_point.point);
              if (distance < nearest_distance)
                {
                  nearest_distance = distance;
                  nearest          = cell->vertex(v);
                }
              // Coordinates are as exact as those of the coarse mesh.
              if (distance >
                  std::max(1e-8, 1e-10 * std::ldexp(1., cell->level())) *
                    cell->diameter())
                continue;
              found = true;
              for (unsigned int d = 0; d < dim; ++d)
                if (fixed_point.components[d])
                  constrain(cell->vertex_dof_index(v, d), d, fixed_point.point);
            }
    });

    if (Utilities::MPI::max(found ? 1 : 0, communicator()) == 0)
      {
        std::ostringstream message;
        message << "[Boundary] Fixed points: "
                << Text::from_point(fixed_point.point)
                << " is no vertex of the mesh";
        if (Utilities::MPI::n_mpi_processes(communicator()) == 1)
          message << "; the nearest one is " << Text::from_point(nearest);
        throw SceneError(message.str());
      }
  }



  template <int dim>
  void
  Space<dim>::constrain(const types::global_dof_index dof,
                        const unsigned int            component,
                        const Point<dim>             &place)
  {
    if (is_tied(dof))
      throw SceneError(
        "[Boundary] Fixed points: component " + std::to_string(component + 1) +
        " at " + Text::from_point(place) +
        " is already tied to another one by an inclined plane of symmetry or a "
        "hanging node; fix another component or another vertex.");
    if (!affine_constraints.is_constrained(dof))
      affine_constraints.add_line(dof);
  }



  template <int dim>
  bool
  Space<dim>::is_tied(const types::global_dof_index dof) const
  {
    const auto *entries = affine_constraints.get_constraint_entries(dof);
    return entries != nullptr && !entries->empty();
  }



  template <int dim>
  MPI_Comm
  Space<dim>::communicator() const
  {
    return triangulation->get_communicator();
  }



  template <int dim>
  Vector
  Space<dim>::ghosted_vector() const
  {
    return Vector(owned_unknowns, relevant_unknowns, communicator());
  }



  template <int dim>
  Vector
  Space<dim>::nodal_vector() const
  {
    IndexSet relevant;
    DoFTools::extract_locally_relevant_dofs(dofs, relevant);
    return Vector(dofs.locally_owned_dofs(), relevant, communicator());
  }



  template <int dim>
  Vector
  Space<dim>::nodal_values(const Vector &displacement) const
  {
    // deal.II 9.6 wants as many entries as the constraints know unknowns, among
    // them those of singular functions, the last.
    Vector unknowns(owned_unknowns, communicator());
    unknowns.copy_locally_owned_data_from(displacement);
    affine_constraints.distribute(unknowns);

    Vector values = nodal_vector();
    for (std::size_t i = 0; i < values.locally_owned_size(); ++i)
      values.local_element(i) = unknowns.local_element(i);
    values.update_ghost_values();
    return values;
  }



  template <int dim>
  const SingularShapes *
  Space<dim>::singular_shapes() const
  {
    return shapes.get();
  }



  template <int dim>
  types::global_dof_index
  Space<dim>::singular_unknown(const unsigned int k) const
  {
    return dofs.n_dofs() + k;
  }



  template <int dim>
  types::global_dof_index
  Space<dim>::n_unknowns() const
  {
    return dofs.n_dofs() + (shapes == nullptr ? 0 : shapes->size());
  }



  template <int dim>
  void
  Space<dim>::get_unknowns(
    const typename DoFHandler<dim>::active_cell_iterator &cell,
    std::vector<types::global_dof_index>                 &indices) const
  {
    indices.resize(fe.n_dofs_per_cell());
    cell->get_dof_indices(indices);
    for (auto i = dofs.n_dofs(); i < n_unknowns(); ++i)
      indices.push_back(i);
  }



  template <int dim>
  unsigned int
  Space<dim>::rule(
    const typename Triangulation<dim>::active_cell_iterator &cell) const
  {
    return rule_of_cell.empty() ? 0 : rule_of_cell[cell->active_cell_index()];
  }



  template <int dim>
  const Quadrature<dim> &
  Space<dim>::quadrature(
    const typename Triangulation<dim>::active_cell_iterator &cell) const
  {
    return rules[rule(cell)];
  }



  template <int dim>
  std::shared_ptr<const MatrixFree<dim, double>>
  Space<dim>::matrix_free() const
  {
    Assert(shapes == nullptr, ExcNotImplemented());
    if (cell_loops == nullptr)
      {
        typename MatrixFree<dim, double>::AdditionalData data;
        data.mapping_update_flags = update_gradients | update_JxW_values;
        data.tasks_parallel_scheme =
          MatrixFree<dim, double>::AdditionalData::none;
        auto loops = std::make_shared<MatrixFree<dim, double>>();
        loops->reinit(
          q1_mapping, dofs, affine_constraints, QGauss<1>(fe.degree + 1), data);
        cell_loops = std::move(loops);
      }
    return cell_loops;
  }



  template class Space<2>;
  template class Space<3>;
} // namespace Crevasse
