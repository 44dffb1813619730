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

#include <crevasse/discretisation/rigid_motions.h>
#include <crevasse/run/body.h>
#include <crevasse/scene/geometry.h>
#include <crevasse/scene/problems.h>

namespace Crevasse
{
  using namespace dealii;

  namespace
  {
    template <int dim>
    std::shared_ptr<const Mesh<dim>>
    make_distributed_mesh(const GeometryParameters &parameters,
                          const MPI_Comm            communicator)
    {
      auto mesh = std::make_shared<Mesh<dim>>(communicator);
      make_mesh(parameters, *mesh);
      return mesh;
    }



    /** Everything else builds on a body that cannot move away. */
    template <int dim>
    const Space<dim> &
    held(const Space<dim> &space)
    {
      require_no_rigid_motion(space);
      return space;
    }
  } // namespace



  BoundaryRoles
  boundary_roles(const Scene &scene)
  {
    const BoundaryRoles roles =
      resolve_roles(scene.boundary, built_in_roles(scene.geometry));
    for (const Expression &component :
         Expression::parse_list(scene.loads.traction))
      if (!component.is_zero() && roles.loaded.empty())
        throw SceneError("[Loads] Traction = " + scene.loads.traction +
                         ": no boundary has the role Loaded that could bear "
                         "it; set [Boundary] Loaded, or the traction to 0.");
    return roles;
  }



  template <int dim>
  std::vector<FixedPoint<dim>>
  fixed_points(const Scene &scene)
  {
    return scene.boundary.fixed_points == "automatic"
             ? built_in_fixed_points<dim>(scene.geometry)
             : parse_fixed_points<dim>(scene.boundary.fixed_points);
  }



  template <int dim>
  Body<dim>::Body(const Scene &scene, const MPI_Comm communicator)
    : effects(scene, boundary_roles(scene))
    , law(scene.material)
    , space(make_distributed_mesh<dim>(scene.geometry, communicator),
            scene.discretisation.degree,
            boundary_roles(scene),
            fixed_points<dim>(scene))
    , points(held(space))
    , strain_operator(space, points)
    , lip(space, Expression(scene.boundary.gap))
    , loads(space, strain_operator, scene.loads)
  {
  }



  template <int dim>
  UnilateralBounds
  unilateral_bounds(const ContactBoundary<dim> &lip)
  {
    UnilateralBounds bounds;
    for (const LipNode<dim> &node : lip.nodes())
      {
        bounds.dofs.push_back(node.dof);
        bounds.sign.push_back(node.sign);
        bounds.gap.push_back(node.gap);
      }
    return bounds;
  }



  template struct Body<2>;
  template UnilateralBounds
  unilateral_bounds<2>(const ContactBoundary<2> &);
  template std::vector<FixedPoint<2>>
  fixed_points<2>(const Scene &);
} // namespace Crevasse
