// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/collectively.h>
#include <crevasse/base/problems.h>
#include <crevasse/base/text.h>
#include <crevasse/discretisation/refinement.h>
#include <crevasse/discretisation/rigid_motions.h>
#include <crevasse/grid/geometry.h>
#include <crevasse/model/body.h>
#include <crevasse/model/solver_memory.h>
#include <crevasse/model/tip_functions.h>
#include <crevasse/parameters/built_in_boundary.h>

#include <optional>
#include <utility>

namespace Crevasse
{
  using namespace dealii;

  namespace
  {
    /** Everything else builds on a body that cannot move away. */
    template <int dim>
    const Space<dim> &
    held(const Space<dim> &space)
    {
      require_no_rigid_motion(space);
      return space;
    }



    /** Which parameter took the loaded boundary of the built-in shape for
     * itself, as a sentence, or nothing if none did. */
    std::string
    who_took_the_loaded_boundary(const Scene &scene)
    {
      if (!scene.boundary.loaded->is_automatic)
        return "";
      for (const auto id : built_in_roles(scene.geometry).loaded)
        for (const BoundaryRole &role : boundary_role_table)
          if (const Parsed<BoundaryList> &list = scene.boundary.*role.list;
              list->ids.count(id) > 0)
            return " The loaded boundary of this shape is the boundary id " +
                   std::to_string(id) + ", which [Boundary] " + role.name +
                   " = " + list.text() + " takes away from it.";
      return "";
    }



    std::string
    list_ids(const char *role, const std::set<types::boundary_id> &ids)
    {
      std::vector<std::string> numbers;
      for (const types::boundary_id id : ids)
        numbers.push_back(std::to_string(id));
      return role + (" " + Text::join(numbers, ", "));
    }



    /** As in a scene: components follow a colon unless all are fixed. */
    template <int dim>
    std::string
    describe_fixed_point(const FixedPoint<dim> &fixed_point)
    {
      std::vector<std::string> components;
      for (unsigned int d = 0; d < dim; ++d)
        if (fixed_point.components[d])
          components.push_back(std::to_string(d + 1));
      return "fixed " + Text::from_point(fixed_point.point) +
             (components.size() < dim ? ": " + Text::join(components, ", ")
                                      : "");
    }
  } // namespace



  namespace
  {
    /** A file may be there for some of the processes only. */
    template <int dim>
    Temperature<dim>
    read_temperature(const LoadParameters &loads, const MPI_Comm communicator)
    {
      std::optional<Temperature<dim>> temperature;
      collectively(communicator, [&]() {
        temperature.emplace(*loads.temperature,
                            loads.temperature.text(),
                            loads.period);
      });
      return std::move(*temperature);
    }
  } // namespace



  BoundaryRoles
  boundary_roles(const Scene &scene)
  {
    const BoundaryRoles roles =
      resolve_roles(scene.boundary, built_in_roles(scene.geometry));
    if (roles.loaded.empty() && !are_zero(*scene.loads.traction))
      throw SceneError("[Loads] Traction = " + scene.loads.traction.text() +
                       ": no boundary has the role Loaded that could bear "
                       "it; set [Boundary] Loaded, or the traction to 0." +
                       who_took_the_loaded_boundary(scene));
    return roles;
  }



  template <int dim>
  std::vector<FixedPoint<dim>>
  fixed_points(const Scene &scene)
  {
    return scene.boundary.fixed_points->is_automatic
             ? built_in_fixed_points<dim>(scene.geometry, boundary_roles(scene))
             : to_fixed_points<dim>(*scene.boundary.fixed_points);
  }



  template <int dim>
  std::string
  describe_boundaries(const Scene &scene)
  {
    const BoundaryRoles      roles = boundary_roles(scene);
    std::vector<std::string> parts;
    const auto               add = [&parts](const char *role, const auto &ids) {
      if (!ids.empty())
        parts.push_back(list_ids(role, ids));
    };
    add("clamped", roles.clamped);
    add("symmetry", roles.symmetry);
    add("loaded", roles.loaded);
    add("contact", roles.contact);
    for (const FixedPoint<dim> &fixed_point : fixed_points<dim>(scene))
      parts.push_back(describe_fixed_point(fixed_point));
    return Text::join(parts, "; ");
  }



  template <int dim>
  std::shared_ptr<Mesh<dim>>
  make_scene_mesh(const Scene &scene, const MPI_Comm communicator)
  {
    const auto unrefined = [&scene, communicator]() {
      auto mesh = std::make_shared<Mesh<dim>>(communicator);
      make_mesh<dim>(scene.geometry, *mesh, [&](const CellCounts &cells) {
        require_room<dim>(scene, cells, communicator);
      });
      return mesh;
    };
    return scene.refinement.strategy == RefinementStrategy::tip
             ? graded_mesh<dim>(unrefined,
                                boundary_roles(scene),
                                scene.refinement,
                                scene.discretisation.degree)
             : unrefined();
  }



  template <int dim>
  Body<dim>::Body(const Scene &scene, const MPI_Comm communicator)
    : Body(scene, make_scene_mesh<dim>(scene, communicator))
  {
  }



  template <int dim>
  Body<dim>::Body(const Scene &scene, std::shared_ptr<const Mesh<dim>> mesh)
    : temperature(read_temperature<dim>(scene.loads, mesh->get_communicator()))
    , effects(scene, boundary_roles(scene), temperature.depends_on_time())
    , law(scene.material)
    , space(
        mesh,
        scene.discretisation.degree,
        boundary_roles(scene),
        fixed_points<dim>(scene),
        scene.discretisation.volumetric_strain,
        tip_functions(scene, *mesh, boundary_roles(scene), law, temperature))
    , points(held(space))
    , material(space, points, law, temperature)
    , strain_operator(space, points)
    , lip(space, Expression(*scene.boundary.gap))
    , loads(space, strain_operator, scene.loads)
  {
    // What the tables say must be what is computed.
    Assert(effects.has_free_strain() == material.has_thermal_strain(),
           ExcInternalError());
    Assert(effects.varying_stiffness.on || !material.stiffness_varies(),
           ExcInternalError());
    Assert(effects.varying_viscosity.on || !material.fluidity_varies(),
           ExcInternalError());
  }



  template <int dim>
  UnilateralBounds
  unilateral_bounds(const ContactBoundary<dim> &lip, const Space<dim> &space)
  {
    UnilateralBounds bounds;
    for (const LipNode<dim> &node : lip.nodes())
      {
        bounds.dofs.push_back(node.dof);
        bounds.sign.push_back(node.sign);
        bounds.gap.push_back(node.gap);
      }
    if (space.singular_shapes() != nullptr &&
        space.locally_owned_unknowns().is_element(space.singular_unknown(0)))
      {
        bounds.dofs.push_back(space.singular_unknown(0));
        bounds.sign.push_back(1.);
        bounds.gap.push_back(0.);
        bounds.n_global = 1;
      }
    return bounds;
  }



  template struct Body<2>;
  template struct Body<3>;
  template UnilateralBounds
  unilateral_bounds<2>(const ContactBoundary<2> &, const Space<2> &);
  template UnilateralBounds
  unilateral_bounds<3>(const ContactBoundary<3> &, const Space<3> &);
  template std::shared_ptr<Mesh<2>>
  make_scene_mesh<2>(const Scene &, const MPI_Comm);
  template std::shared_ptr<Mesh<3>>
  make_scene_mesh<3>(const Scene &, const MPI_Comm);
  template std::vector<FixedPoint<2>>
  fixed_points<2>(const Scene &);
  template std::vector<FixedPoint<3>>
  fixed_points<3>(const Scene &);
  template std::string
  describe_boundaries<2>(const Scene &);
  template std::string
  describe_boundaries<3>(const Scene &);
} // namespace Crevasse
