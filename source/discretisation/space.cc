// ---------------------------------------------------------------------
//
// Copyright (C) 2026 by the Crevasse authors
//
// This file is part of Crevasse. It is free software; you can use it,
// redistribute it and/or modify it under the terms of the GNU Lesser
// General Public License as published by the Free Software Foundation;
// either version 2.1 of the License, or (at your option) any later version.
//
// ---------------------------------------------------------------------

#include <crevasse/discretisation/space.h>
#include <crevasse/scene/collectively.h>
#include <crevasse/scene/problems.h>
#include <crevasse/scene/text.h>

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
                    const VolumetricStrain              volumetric_strain)
    : triangulation(std::move(mesh))
    , fe(FE_Q<dim>(degree), dim)
    , cell_rule(degree + 1)
    , face_rule(degree + 1)
    , boundary_roles(roles)
    , volumetric(volumetric_strain)
    , dofs(*triangulation)
  {
    Assert(degree == 1 || volumetric == VolumetricStrain::full,
           ExcMessage("Mean dilatation is for linear elements."));
    check_roles();
    dofs.distribute_dofs(fe);
    make_constraints(fixed_points);
  }



  template <int dim>
  void
  Space<dim>::check_roles() const
  {
    // On the coarse mesh, which every rank knows whole.
    std::set<types::boundary_id> existing;
    for (const auto &cell : triangulation->cell_iterators_on_level(0))
      for (const auto &face : cell->face_iterators())
        if (face->at_boundary())
          existing.insert(face->boundary_id());

    std::ostringstream list;
    for (const auto id : existing)
      list << ' ' << id;

    Problems   problems;
    const auto check = [&](const char                         *role,
                           const std::set<types::boundary_id> &ids) {
      for (const auto id : ids)
        if (existing.count(id) == 0)
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
  Space<dim>::make_constraints(const std::vector<FixedPoint<dim>> &fixed_points)
  {
    IndexSet relevant;
    DoFTools::extract_locally_relevant_dofs(dofs, relevant);
    affine_constraints.reinit(relevant);

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
    for (const FixedPoint<dim> &fixed_point : fixed_points)
      constrain(fixed_point);
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
    if (!affine_constraints.is_constrained(dof))
      affine_constraints.add_line(dof);
    else if (!affine_constraints.get_constraint_entries(dof)->empty())
      throw SceneError(
        "[Boundary] Fixed points: component " + std::to_string(component + 1) +
        " at " + Text::from_point(place) +
        " is already tied to another one by an inclined plane of symmetry or a "
        "hanging node; fix another component or another vertex.");
  }



  template <int dim>
  const Mesh<dim> &
  Space<dim>::mesh() const
  {
    return *triangulation;
  }



  template <int dim>
  std::shared_ptr<const Mesh<dim>>
  Space<dim>::shared_mesh() const
  {
    return triangulation;
  }



  template <int dim>
  const DoFHandler<dim> &
  Space<dim>::dof_handler() const
  {
    return dofs;
  }



  template <int dim>
  const FESystem<dim> &
  Space<dim>::finite_element() const
  {
    return fe;
  }



  template <int dim>
  const Mapping<dim> &
  Space<dim>::mapping() const
  {
    return q1_mapping;
  }



  template <int dim>
  const AffineConstraints<double> &
  Space<dim>::constraints() const
  {
    return affine_constraints;
  }



  template <int dim>
  const BoundaryRoles &
  Space<dim>::roles() const
  {
    return boundary_roles;
  }



  template <int dim>
  VolumetricStrain
  Space<dim>::volumetric_strain() const
  {
    return volumetric;
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
    IndexSet relevant;
    DoFTools::extract_locally_relevant_dofs(dofs, relevant);
    return Vector(dofs.locally_owned_dofs(), relevant, communicator());
  }



  template <int dim>
  const Quadrature<dim> &
  Space<dim>::quadrature() const
  {
    return cell_rule;
  }



  template <int dim>
  const Quadrature<dim - 1> &
  Space<dim>::face_quadrature() const
  {
    return face_rule;
  }



  template class Space<2>;
  template class Space<3>;
} // namespace Crevasse
