// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/collectively.h>
#include <crevasse/base/problems.h>
#include <crevasse/base/text.h>
#include <crevasse/grid/curved_edges.h>
#include <crevasse/grid/front_curve.h>
#include <crevasse/model/body.h>
#include <crevasse/model/linear_choice.h>
#include <crevasse/model/mesh_materials.h>
#include <crevasse/model/refinement.h>
#include <crevasse/parameters/automatic.h>
#include <crevasse/parameters/built_in_boundary.h>
#include <crevasse/parameters/physical_names.h>

#include <deal.II/fe/mapping_q1.h>

#include <boost/algorithm/string/case_conv.hpp>

namespace Crevasse
{
  using namespace dealii;

  namespace
  {
    /** Reads the temperature. Its file may exist for some processes only. */
    template <int dim>
    Temperature<dim>
    read_temperature(const LoadParameters &loads, const MPI_Comm communicator)
    {
      std::optional<Temperature<dim>> temperature;
      collectively(communicator, [&]() {
        temperature.emplace(*loads.temperature,
                            loads.temperature.text(),
                            loads.period,
                            loads.reference->value_or(0.));
      });
      return std::move(*temperature);
    }



    /** Makes the fronts smooth along which the scene asks for K or C(t). */
    void
    smooth_fronts_of(const Scene &scene, Triangulation<3> &mesh, Log *log)
    {
      const BoundaryRoles roles = boundary_roles(scene);
      if (!has_curved_edges(mesh) ||
          !(stress_intensity_effect(scene, roles).on ||
            scene.crack_tip.creep_integral))
        return;
      const double moved = smooth_fronts(mesh, roles);
      if (moved > 0. && log != nullptr)
        log->line(
          Text::format("  mesh file: the crack front is made smooth: "
                       "middles of its edges move by up to %.2g %% of "
                       "their lengths",
                       100. * moved));
    }



    /** Size of the smallest cell at the tip, over all ranks. */
    double
    cell_size_at(const CrackTip &tip, const Mesh<2> &mesh)
    {
      double size = std::numeric_limits<double>::max();
      for (const auto &cell : owned_cells(mesh))
        for (const unsigned int v : cell->vertex_indices())
          if (cell->vertex(v).distance(tip.position) < 1e-8 * cell->diameter())
            size = std::min(size, cell->minimum_vertex_distance());
      return Utilities::MPI::min(size, mesh.get_communicator());
    }



    /** Singular functions of [Discretisation]. Collective. @throw SceneError as
     * stiffness_at() does, or if the stiffness at a tip is anisotropic or the
     * straight part of a crack too short. */
    template <int dim>
    SingularFunctions
    tip_functions(const Scene            &scene,
                  const Mesh<dim>        &mesh,
                  const MaxwellLaw<dim>  &law,
                  const Temperature<dim> &temperature)
    {
      constexpr double    fewest_cells = 2.;
      const unsigned int  n            = singular_functions(scene).n;
      const BoundaryRoles roles        = boundary_roles(scene);
      SingularFunctions   functions;
      if constexpr (dim == 2)
        if (n > 0)
          {
            const std::string wanted_by =
              "[Discretisation] Singular functions = " + std::to_string(n);
            for (const CrackTip &tip : crack_tips(mesh, roles, wanted_by))
              {
                const double size   = cell_size_at(tip, mesh);
                const double radius = straight_length(mesh, roles, tip);
                if (radius < fewest_cells * size * (1. - 1e-10))
                  throw SceneError(wanted_by + ": at the crack tip " +
                                   Text::from_point(tip.position) +
                                   " the crack is straight and away from other "
                                   "boundaries for " +
                                   Text::from_number(radius) +
                                   ", less than two cells of the size " +
                                   Text::from_number(size) +
                                   ". Make the cells smaller ([Geometry] "
                                   "Refinements or [Refinement] Strategy = "
                                   "tip), or set Singular functions = 0.");
                const VoigtMatrix<2> stiffness =
                  stiffness_at(tip, mesh, law, temperature, 0., wanted_by);
                if (!PlaneElasticity::is_isotropic(stiffness))
                  throw SceneError(wanted_by +
                                   ": the stiffness at the crack "
                                   "tip " +
                                   Text::from_point(tip.position) +
                                   " is not isotropic, but singular functions "
                                   "are those of isotropic bodies. Set it to "
                                   "0.");
                const SingularFunctions of_tip = make_singular_functions(
                  n, tip, PlaneElasticity(stiffness), size, radius);
                functions.insert(functions.end(), of_tip.begin(), of_tip.end());
              }
          }
      return functions;
    }
  } // namespace



  BoundaryRoles
  boundary_roles(const Scene &scene)
  {
    BoundaryRoles roles =
      resolve_roles(scene.boundary, built_in_roles(scene.geometry));
    roles.has_axis = scene.is_axisymmetric();
    for (const auto id : roles.displaced)
      if (const auto *placed = placed_on(id, scene.loads.displacement))
        for (const unsigned int d : placed->free)
          roles.free.emplace(id, d);
    for (const LoadParameters::Force &force : scene.loads.forces())
      if (!force.in_volume && roles.loaded.empty() &&
          !are_zero(force.formulas()))
        {
          const auto built_in = built_in_roles(scene.geometry).loaded;
          const bool is_taken =
            !built_in.empty() && scene.boundary.loaded->is_automatic;
          throw SceneError(
            std::string("[Loads] ") + force.parameter + " = " +
            force.values.text() +
            ": no boundary has the role Loaded; set [Boundary] Loaded, or "
            "the " +
            force.effect + " to 0." +
            (is_taken ? " The default of this shape is the boundary id " +
                          std::to_string(*built_in.begin()) +
                          ", which has another role."
                      : ""));
        }
    return roles;
  }



  template <int dim>
  std::vector<FixedPoint<dim>>
  fixed_points(const Scene &scene)
  {
    // Without built-in supports, which would only hold a radius.
    if (scene.boundary.fixed_points->is_automatic && scene.is_axisymmetric())
      return {};
    return scene.boundary.fixed_points->is_automatic
             ? built_in_fixed_points<dim>(scene.geometry, boundary_roles(scene))
             : to_fixed_points<dim>(*scene.boundary.fixed_points);
  }



  template <int dim>
  std::string
  describe_boundaries(const Scene &scene)
  {
    const BoundaryRoles                 roles = boundary_roles(scene);
    std::map<unsigned int, std::string> names;
    if (scene.geometry.shape == Shape::mesh_file)
      names = boundary_names(scene);
    std::vector<std::string> parts;
    for (const BoundaryRole &role : boundary_role_table)
      {
        std::vector<std::string> numbers;
        for (const auto id : roles.*role.ids)
          numbers.push_back(std::to_string(id) + (names.count(id) > 0
                                                    ? " (" + names.at(id) + ')'
                                                    : ""));
        if (!numbers.empty())
          parts.push_back(
            boost::algorithm::to_lower_copy(std::string(role.name)) + ' ' +
            Text::join(numbers, ", "));
      }
    // Format of scenes: components follow a colon unless all are fixed.
    for (const FixedPoint<dim> &fixed : fixed_points<dim>(scene))
      {
        std::vector<std::string> components;
        for (unsigned int d = 0; d < dim; ++d)
          if (fixed.components[d])
            components.push_back(std::to_string(d + 1));
        parts.push_back(
          "fixed " + Text::from_point(fixed.point) +
          (components.size() < dim ? ": " + Text::join(components, ", ") : ""));
      }
    return Text::join(parts, "; ");
  }



  template <int dim>
  std::shared_ptr<Mesh<dim>>
  make_scene_mesh(const Scene &scene, const MPI_Comm communicator, Log *log)
  {
    const auto unrefined = [&scene, communicator, &log]() {
      auto mesh = std::make_shared<Mesh<dim>>(communicator);
      make_mesh<dim>(scene.geometry,
                     *mesh,
                     [&](const CellCounts &cells) {
                       require_room<dim>(scene, cells, communicator);
                       for (const std::string &remark : cells.remarks)
                         if (log != nullptr)
                           log->line("  mesh file: " + remark);
                     },
                     {boundary_roles(scene), compared_materials(scene)});
      // The centre of a face between arcs would have to lie on its surface.
      if (dim == 3 && has_curved_edges(*mesh) &&
          (scene.geometry.refinements > 0 ||
           scene.refinement.strategy != RefinementStrategy::none))
        throw SceneError(
          "[Geometry] Mesh file = " + scene.geometry.mesh_file +
          ": in three dimensions the program cannot refine a mesh with curved "
          "edges; use a finer mesh file, with [Geometry] Refinements = 0 and "
          "[Refinement] Strategy = none.");
      if constexpr (dim == 3)
        smooth_fronts_of(scene, *mesh, log);
      log = nullptr; // several meshes may be made
      return mesh;
    };
    RefinementParameters refinement = scene.refinement;
    if (const unsigned int cycles = automatic_cycles(scene))
      {
        refinement.strategy        = RefinementStrategy::tip;
        refinement.cycles          = cycles;
        refinement.target_unknowns = 0;
      }
    return refinement.strategy == RefinementStrategy::tip
             ? graded_mesh<dim>(unrefined,
                                boundary_roles(scene),
                                refinement,
                                scene.discretisation.degree)
             : unrefined();
  }



  template <int dim>
  Body<dim>::Body(const Scene &scene, std::shared_ptr<const Mesh<dim>> mesh)
    : temperature(read_temperature<dim>(scene.loads, mesh->get_communicator()))
    , effects(scene, boundary_roles(scene), temperature.depends_on_time())
    , law(scene.material)
    , space(mesh,
            scene.discretisation.degree,
            boundary_roles(scene),
            fixed_points<dim>(scene),
            scene.discretisation.volumetric_strain,
            tip_functions(scene, *mesh, law, temperature))
    , held_by_contact(rigid_motions_held_by_contact(space))
    , points(space)
    , imposed(space, points, scene.loads)
    , material(space, points, law, temperature, &imposed)
    , strain_operator(space, points)
    , lip(space.lip,
          space.dof_handler,
          space.locally_owned_unknowns,
          Expression(*scene.boundary.gap))
    , loads(space, strain_operator, scene.loads)
  {
    if (const auto &mu = scene.boundary.friction; space.lip.has_friction)
      friction.emplace(lip, space.dof_handler, temperature, mu);
    require_materials(scene, *mesh);
    // Effects in the tables must agree with the computation.
    Assert((Effects::first_on(effects.free_strains) != nullptr) ==
             material.has_thermal_strain,
           ExcInternalError());
    Assert(effects.varying_stiffness.on || !material.stiffness_varies,
           ExcInternalError());
    Assert(effects.varying_viscosity.on || !material.fluidity_varies,
           ExcInternalError());
  }



  template <int dim>
  Vector
  Body<dim>::nodal_displacement(const Vector &displacement,
                                const double  t,
                                const double  time) const
  {
    Vector nodal = space.nodal_values(displacement);
    if (imposed.is_on)
      imposed.add_values(imposed.values(t, time), nodal);
    return nodal;
  }



  template <int dim>
  UnilateralBounds
  unilateral_bounds(const ContactBoundary<dim>     &lip,
                    const Space<dim>               &space,
                    const std::vector<RigidMotion> &motions)
  {
    UnilateralBounds bounds;
    for (const LipNode<dim> &node : lip.nodes)
      {
        bounds.dofs.push_back(node.unknown);
        bounds.sign.push_back(node.sign);
        bounds.gap.push_back(node.gap);
      }
    if (const SingularShapes *const shapes = space.singular_shapes())
      for (unsigned int k = 0; k < shapes->size(); ++k)
        if (const auto unknown = space.singular_unknown(k);
            shapes->functions[k].opens() &&
            space.locally_owned_unknowns.is_element(unknown))
          {
            bounds.dofs.push_back(unknown);
            bounds.sign.push_back(1.);
            bounds.gap.push_back(0.);
          }
    if (lip.basis.has_friction)
      for (unsigned int c = 0; c < dim - 1; ++c)
        {
          auto &along = bounds.tangents.emplace_back();
          for (const LipNode<dim> &node : lip.nodes)
            along.push_back(node.sliding[c]);
        }
    for (const auto &nodes_of_face : lip.basis.nodes_of_faces)
      {
        auto &face = bounds.faces.emplace_back();
        for (const unsigned int i : nodes_of_face)
          if (const auto &node = lip.basis.nodes[i]; node.has_unknown())
            face.push_back(node.unknown);
      }
    for (const RigidMotion &motion : motions)
      {
        bounds.free_motions.push_back({motion.name, {}});
        for (unsigned int k = 0; k < bounds.dofs.size(); ++k)
          bounds.free_motions.back().openings.push_back(
            bounds.sign[k] * motion.displacement(bounds.dofs[k]));
      }
    return bounds;
  }



#define INSTANTIATE(dim)                                              \
  template struct Body<dim>;                                          \
  template decltype(unilateral_bounds<dim>)   unilateral_bounds<dim>; \
  template decltype(make_scene_mesh<dim>)     make_scene_mesh<dim>;   \
  template decltype(fixed_points<dim>)        fixed_points<dim>;      \
  template decltype(describe_boundaries<dim>) describe_boundaries<dim>

  INSTANTIATE(2);
  INSTANTIATE(3);

#undef INSTANTIATE
} // namespace Crevasse
