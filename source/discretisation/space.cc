// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/collectively.h>
#include <crevasse/base/problems.h>
#include <crevasse/base/text.h>
#include <crevasse/discretisation/cell_loops.h>
#include <crevasse/discretisation/rigid_motions.h>
#include <crevasse/discretisation/space.h>
#include <crevasse/grid/curved_edges.h>
#include <crevasse/parameters/parameters.h>

#include <deal.II/fe/fe_q.h>
#include <deal.II/numerics/vector_tools.h>

#include <algorithm>
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
                    const SingularFunctions            &singular_functions,
                    const bool                          lips_closed)
    : triangulation(std::move(mesh))
    , finite_element(FE_Q<dim>(degree), dim)
    , dof_handler(*triangulation)
    , mapping(has_curved_edges(*triangulation) ? degree : 1, roles.has_axis)
    , roles(roles)
    , volumetric_strain(volumetric_strain)
    , face_rule(singular_functions.empty() ? degree + 1 : 5)
    , supports(fixed_points)
  {
    Assert(degree == 1 || volumetric_strain == VolumetricStrain::full,
           ExcMessage("Mean dilatation is for linear elements."));
    check_roles();
    dof_handler.distribute_dofs(finite_element);
    if constexpr (dim == 2)
      if (!singular_functions.empty())
        shapes = std::make_unique<SingularShapes>(singular_functions,
                                                  mapping,
                                                  dof_handler,
                                                  face_rule);
    make_supports();
    lip = LipBasis<dim>(
      dof_handler, mapping, face_rule, roles, supports_and_hanging);
    number_unknowns();
    choose_rules();
    make_constraints(lips_closed);
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
    if (existing == std::vector<types::boundary_id>{0})
      list << ". 0 is the id of faces in no physical group: give each boundary "
              "a group of its own, in Gmsh as by Physical "
           << (dim == 2 ? "Curve" : "Surface") << "(\"lip\", 2) = {5}";

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
    for (const BoundaryRole &role : boundary_role_table)
      check(role.name, roles.*role.ids);
    problems.throw_if_any();
    require_flat_faces(*triangulation, "Symmetry", roles.symmetry);
    require_flat_faces(*triangulation, "Contact", roles.contact);
  }



  template <int dim>
  void
  Space<dim>::number_unknowns()
  {
    locally_owned_unknowns.set_size(n_unknowns());
    locally_owned_unknowns.add_indices(dof_handler.locally_owned_dofs());
    if (Utilities::MPI::this_mpi_process(communicator()) + 1 ==
        Utilities::MPI::n_mpi_processes(communicator()))
      locally_owned_unknowns.add_range(dof_handler.n_dofs(), n_unknowns());
    locally_relevant_unknowns.set_size(n_unknowns());
    locally_relevant_unknowns.add_indices(
      supports_and_hanging.get_local_lines());
    locally_relevant_unknowns.add_range(dof_handler.n_dofs(), n_unknowns());
    for (IndexSet *set : {&locally_owned_unknowns, &locally_relevant_unknowns})
      set->compress();
    partitioner = std::make_shared<const Utilities::MPI::Partitioner>(
      locally_owned_unknowns, locally_relevant_unknowns, communicator());
  }



  template <int dim>
  void
  Space<dim>::choose_rules()
  {
    if (shapes == nullptr)
      {
        quadratures.push_back(QGauss<dim>(finite_element.degree + 1));
        return;
      }
    quadratures.push_back(QGauss<dim>(finite_element.degree + 2));
    if constexpr (dim == 2)
      {
        // Exponent of Mousavi and Sukumar (Comput. Mech. 45, 2010) for 1/√r.
        constexpr double beta = 2., near_size = 3.5;
        quadratures.push_back(QGauss<dim>(5));
        for (const unsigned int v : GeometryInfo<dim>::vertex_indices())
          quadratures.push_back(
            QSplit<dim>(QDuffy(5, beta),
                        GeometryInfo<dim>::unit_cell_vertex(v)));

        rule_of_cell.assign(triangulation->n_active_cells(), 0);
        for (const auto &cell : triangulation->active_cell_iterators())
          for (const SingularFunction &function : shapes->functions)
            {
              const auto  &tip  = function.tip.position;
              const double size = cell->diameter() / std::sqrt(2.);
              auto        &rule = rule_of_cell[cell->active_cell_index()];
              if (rule == 0 && cell->center().distance(tip) < near_size * size)
                rule = 1;
              for (const unsigned int v : cell->vertex_indices())
                if (cell->vertex(v).distance(tip) < 1e-8 * size)
                  rule = 2 + v;
            }
      }
  }



  template <int dim>
  void
  Space<dim>::make_supports()
  {
    auto &all = supports_and_hanging;
    all.reinit(DoFTools::extract_locally_relevant_dofs(dof_handler));
    DoFTools::make_hanging_node_constraints(dof_handler, all);
    hold_boundaries();
    if (!roles.symmetry.empty())
      VectorTools::compute_no_normal_flux_constraints(
        dof_handler, 0, roles.symmetry, all, mapping);
    hold_axis();
    for (const FixedPoint<dim> &fixed_point : supports)
      constrain(fixed_point);
    all.close();
  }



  template <int dim>
  void
  Space<dim>::make_constraints(const bool lips_closed)
  {
    constraints.reinit(locally_relevant_unknowns);
    const auto add = [&](const auto index, const auto &entries) {
      constraints.add_line(index);
      constraints.add_entries(index, entries);
    };
    for (const auto &line : supports_and_hanging.get_lines())
      add(line.index, line.entries);
    for (const auto &[index, entries] : lip.combinations)
      if (constraints.can_store_line(index))
        add(index, entries);
    for (const auto &node : lip.nodes)
      if (lips_closed && node.has_unknown() &&
          constraints.can_store_line(node.unknown))
        constraints.add_line(node.unknown);
    // Opening functions are fixed if there is no lip to open.
    for (unsigned int k = 0; shapes != nullptr && k < shapes->size(); ++k)
      if (shapes->functions[k].opens() && (!roles.has_lip() || lips_closed))
        constraints.add_line(singular_unknown(k));
    constraints.close();
  }



  template <int dim>
  void
  Space<dim>::constrain(const FixedPoint<dim> &fixed_point)
  {
    bool found = false;
    collectively(communicator(), [&]() {
      for (const auto &cell : dof_handler.active_cell_iterators())
        if (!cell->is_artificial())
          for (const unsigned int v : cell->vertex_indices())
            {
              // Coordinates are as accurate as those of the coarse mesh.
              if (cell->vertex(v).distance(fixed_point.point) >
                  std::max(1e-8, 1e-10 * std::ldexp(1., cell->level())) *
                    cell->diameter())
                continue;
              found = true;
              for (unsigned int d = 0; d < dim; ++d)
                if (const auto dof = cell->vertex_dof_index(v, d);
                    fixed_point.components[d])
                  {
                    if (is_tied(dof))
                      throw SceneError(
                        "[Boundary] Fixed points: component " +
                        std::to_string(d + 1) + " at " +
                        Text::from_point(fixed_point.point) +
                        " is already tied to another one by an inclined plane "
                        "of symmetry or a hanging node; fix another component "
                        "or another vertex.");
                    if (!supports_and_hanging.is_constrained(dof))
                      supports_and_hanging.add_line(dof);
                  }
            }
    });
    if (Utilities::MPI::max(found ? 1 : 0, communicator()) == 0)
      throw SceneError(
        "[Boundary] Fixed points: " + Text::from_point(fixed_point.point) +
        " is no vertex of the mesh; the nearest one is " +
        Text::from_point(*nearest_free_vertex({fixed_point.point, {}}, {})));
  }



  template <int dim>
  Vector
  Space<dim>::nodal_values(const Vector &displacement) const
  {
    // deal.II 9.6 requires an entry for each unknown of the constraints.
    Vector unknowns(locally_owned_unknowns, communicator());
    unknowns.copy_locally_owned_data_from(displacement);
    constraints.distribute(unknowns);

    Vector values = make_vector(dof_handler);
    std::copy_n(unknowns.begin(), values.locally_owned_size(), values.begin());
    values.update_ghost_values();
    return values;
  }



  template <int dim>
  Vector
  Space<dim>::from_nodal_values(const Vector &values) const
  {
    const IndexSet &dofs         = dof_handler.locally_owned_dofs();
    Vector          displacement = ghosted_vector();
    for (const auto &[unknown, weights] : lip.functionals)
      for (const auto &[dof, weight] : weights)
        if (dofs.is_element(dof))
          displacement(unknown) += weight * values(dof);
    displacement.compress(VectorOperation::add);
    std::copy_n(values.begin(), dofs.n_elements(), displacement.begin());
    constraints.set_zero(displacement);
    return displacement;
  }



  template <int dim>
  void
  Space<dim>::get_unknowns(
    const typename DoFHandler<dim>::active_cell_iterator &cell,
    std::vector<types::global_dof_index>                 &indices) const
  {
    indices.resize(finite_element.n_dofs_per_cell());
    cell->get_dof_indices(indices);
    for (auto i = singular_unknown(0); i < n_unknowns(); ++i)
      indices.push_back(i);
  }



  template <int dim>
  std::shared_ptr<const CellLoops<dim>>
  Space<dim>::cell_loops() const
  {
    if (loops == nullptr)
      loops = std::make_shared<const CellLoops<dim>>(*this);
    return loops;
  }



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

    // Compare the distance, then the coordinates: all ranks choose the same of
    // equally near vertices.
    constexpr double            far = std::numeric_limits<double>::max();
    std::array<double, dim + 1> nearest;
    nearest.fill(far);
    for (const auto &cell : owned_cells(dof_handler))
      for (const unsigned int v : cell->vertex_indices())
        {
          std::array<double, dim + 1> candidate;
          candidate[0] = cell->vertex(v).distance(fixed_point.point);
          for (unsigned int d = 0; d < dim; ++d)
            candidate[d + 1] = cell->vertex(v)[d];
          if (candidate < nearest && is_free(cell, v))
            nearest = candidate;
        }
    for (const auto &of_rank :
         Utilities::MPI::all_gather(communicator(), nearest))
      nearest = std::min(nearest, of_rank);
    if (nearest[0] == far)
      return {};
    Point<dim> vertex;
    for (unsigned int d = 0; d < dim; ++d)
      vertex[d] = nearest[d + 1];
    return vertex;
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
        std::vector<Point<dim>> taken; // taken by other points
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
        coarser_mesh, finite_element.degree, roles, fixed, volumetric_strain);
    };
    try
      {
        auto coarser = make_space({});
        if (supports.empty())
          return coarser;
        coarser = make_space(coarser->at_vertices(supports));
        return find_free_rigid_motions(*coarser).empty() ? coarser : nullptr;
      }
    catch (const SceneError &)
      {
        // Coarsening may leave different cells at the two lips.
        if (roles.crack.empty())
          throw;
        return nullptr;
      }
  }



  template class Space<2>;
  template class Space<3>;
} // namespace Crevasse
