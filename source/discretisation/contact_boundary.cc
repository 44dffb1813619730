// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/collectively.h>
#include <crevasse/base/problems.h>
#include <crevasse/base/text.h>
#include <crevasse/discretisation/contact_boundary.h>

#include <deal.II/base/bounding_box.h>
#include <deal.II/grid/grid_tools.h>

#include <algorithm>
#include <limits>

namespace Crevasse
{
  using namespace dealii;

  namespace
  {
    /** The axis of a lip's normal and the sign of the inward one. */
    template <int dim>
    std::pair<unsigned int, double>
    inward_axis(const Tensor<1, dim> &outward_normal, const Point<dim> &place)
    {
      for (unsigned int d = 0; d < dim; ++d)
        if (std::abs(outward_normal[d]) > 1. - 1e-10)
          return {d, outward_normal[d] > 0. ? -1. : 1.};
      throw SceneError(
        "[Boundary] Contact: the face at " + Text::from_point(place) +
        " has the normal " + Text::from_point(Point<dim>(outward_normal)) +
        ", but the crack lip must be parallel to a coordinate axis: turn the "
        "mesh.");
    }



    /** The component of each dof that this rank sees. */
    template <int dim>
    std::map<types::global_dof_index, unsigned int>
    components_of_dofs(const Space<dim> &space)
    {
      const FESystem<dim>                            &fe = space.finite_element;
      std::map<types::global_dof_index, unsigned int> components;
      std::vector<types::global_dof_index> indices(fe.n_dofs_per_cell());
      for (const auto &cell : space.dof_handler.active_cell_iterators())
        if (!cell->is_artificial())
          {
            cell->get_dof_indices(indices);
            for (unsigned int i = 0; i < indices.size(); ++i)
              components[indices[i]] = fe.system_to_component_index(i).first;
          }
      return components;
    }



    /** What coordinates of the body round to. */
    template <int dim>
    double
    rounding_of_coordinates(const Triangulation<dim> &mesh)
    {
      const BoundingBox<dim> box     = GridTools::compute_bounding_box(mesh);
      const auto            &corners = box.get_boundary_points();
      return 1e-15 * (corners.first.norm() + corners.second.norm());
    }



    /** A constrained node of the lip must be held at zero, or hang between
     * nodes of the lip. One that depends on other components, as on an inclined
     * plane of symmetry, could penetrate without anybody noticing. */
    template <int dim>
    void
    require_held_or_hanging(const Space<dim>                &space,
                            const std::vector<LipNode<dim>> &nodes)
    {
      std::map<types::global_dof_index, unsigned int> components;
      for (const LipNode<dim> &node : nodes)
        for (const auto &[dof, factor] :
             *space.constraints.get_constraint_entries(node.dof))
          {
            (void)factor;
            if (components.empty())
              components = components_of_dofs(space);
            if (components.at(dof) != node.component)
              throw SceneError(
                "[Boundary] Contact: the normal displacement of the lip's node "
                "at " +
                Text::from_point(node.point) +
                " is tied to another one by an inclined plane of symmetry, so "
                "that contact cannot be imposed there. Let the lip end "
                "elsewhere, or turn the mesh so that the plane is parallel to "
                "an axis.");
          }
    }



    /** Two lips that meet in one node press it from both sides: it cannot be
     * kept off a plane. */
    template <int dim>
    void
    require_same_side(const LipNode<dim> &one, const LipNode<dim> &other)
    {
      if (one.sign != other.sign)
        throw SceneError(
          "[Boundary] Contact: at " + Text::from_point(one.point) +
          " two faces with opposite normals share a node. The lip touches its "
          "plane of symmetry from one side: this is not the half model of a "
          "crack. Model the half above or below the plane, with the crack as "
          "Contact and the rest of the plane as Symmetry.");
    }



    /** Calls f(nodes) for the faces of the lip that this rank sees, with the
     * weights of this face. */
    template <int dim, typename Function>
    void
    for_each_face(const Space<dim> &space, const Function &f)
    {
      const FESystem<dim>                 &fe = space.finite_element;
      FEFaceValues<dim>                    values(space.mapping,
                               fe,
                               space.face_quadrature(),
                               update_values | update_normal_vectors |
                                 update_JxW_values);
      FEValues<dim>                        support_values(space.mapping,
                                   fe,
                                   Quadrature<dim>(
                                     fe.get_unit_support_points()),
                                   update_quadrature_points);
      std::vector<types::global_dof_index> indices(fe.n_dofs_per_cell());
      for (const auto &cell : space.dof_handler.active_cell_iterators())
        for (const unsigned int face : cell->face_indices())
          if (!cell->is_artificial() && cell->at_boundary(face) &&
              space.roles.contact.count(cell->face(face)->boundary_id()) > 0)
            {
              values.reinit(cell, face);
              support_values.reinit(cell);
              cell->get_dof_indices(indices);
              const auto [axis, sign] =
                inward_axis<dim>(values.normal_vector(0),
                                 cell->face(face)->center());
              std::vector<LipNode<dim>> nodes;
              for (unsigned int i = 0; i < indices.size(); ++i)
                if (fe.system_to_component_index(i).first == axis &&
                    fe.has_support_on_face(i, face))
                  {
                    LipNode<dim> node;
                    node.dof       = indices[i];
                    node.component = axis;
                    node.sign      = sign;
                    node.point     = support_values.quadrature_point(i);
                    for (const unsigned int q :
                         values.quadrature_point_indices())
                      node.weight += values.shape_value_component(i, q, axis) *
                                     values.JxW(q);
                    nodes.push_back(node);
                  }
              f(nodes);
            }
    }
  } // namespace



  template <int dim>
  ContactBoundary<dim>::ContactBoundary(const Space<dim> &space,
                                        Expression      &&gap_formula)
    : gap(std::move(gap_formula))
    , rounding(rounding_of_coordinates<dim>(space.mesh()))
  {
    collectively(space.communicator(), [&]() { find_nodes(space); });
    share_weights(space);
  }



  template <int dim>
  void
  ContactBoundary<dim>::find_nodes(const Space<dim> &space)
  {
    const IndexSet &owned       = space.dof_handler.locally_owned_dofs();
    const auto     &constraints = space.constraints;

    // Weights are sums over the faces of all ranks that share a node; ghost
    // cells are visited too instead of communicating.
    std::map<types::global_dof_index, LipNode<dim>> found;
    std::map<types::global_dof_index,
             std::pair<double, types::global_dof_index>>
      nearest; // free node on a face of a constrained one, and how far it is
    for_each_face(space, [&](const std::vector<LipNode<dim>> &on_face) {
      for (const LipNode<dim> &node : on_face)
        {
          if (!owned.is_element(node.dof))
            continue;
          const auto [entry, is_new] = found.emplace(node.dof, node);
          if (!is_new)
            {
              require_same_side(entry->second, node);
              entry->second.weight += node.weight;
            }
          if (!constraints.is_constrained(node.dof))
            continue;
          // Cells come in the same order on any number of ranks, and the first
          // of equals stays.
          auto &[distance, dof] =
            nearest
              .emplace(node.dof,
                       std::make_pair(std::numeric_limits<double>::max(),
                                      numbers::invalid_dof_index))
              .first->second;
          for (const LipNode<dim> &other : on_face)
            if (const double length = other.point.distance(node.point);
                !constraints.is_constrained(other.dof) &&
                length < (1. - 1e-10) * distance)
              {
                distance = length;
                dof      = other.dof;
              }
        }
    });

    std::vector<LipNode<dim>> constrained;
    for (auto &[dof, node] : found)
      {
        node.gap = gap_at(node.point);
        if (nearest.count(dof) == 0)
          nodes.push_back(node);
        else
          constrained.push_back(node);
      }
    require_held_or_hanging(space, constrained);
    for (const LipNode<dim> &node : constrained)
      held_nodes.push_back(
        held_node(node, constraints, nearest[node.dof].second));
  }



  template <int dim>
  typename ContactBoundary<dim>::HeldNode
  ContactBoundary<dim>::held_node(const LipNode<dim>              &node,
                                  const AffineConstraints<double> &constraints,
                                  const types::global_dof_index    nearest)
  {
    HeldNode                held{node.dof, {}, node.weight};
    double                  rest      = 1.;
    double                  most      = 0.;
    types::global_dof_index strongest = nearest;
    for (const auto &[dof, factor] :
         *constraints.get_constraint_entries(node.dof))
      {
        held.masters.push_back({dof, factor, true});
        rest -= factor;
        if (factor > most)
          {
            most      = factor;
            strongest = dof;
          }
      }
    // What a hanging node has from held ones, the nearest of the others has to
    // tell.
    if (std::abs(rest) > 1e-10 && strongest != numbers::invalid_dof_index)
      held.masters.push_back({strongest, rest, false});
    return held;
  }



  template <int dim>
  void
  ContactBoundary<dim>::share_weights(const Space<dim> &space)
  {
    Vector interpolated = space.ghosted_vector();
    Vector held         = space.ghosted_vector();
    for (const HeldNode &node : held_nodes)
      for (const MasterNode &master : node.masters)
        (master.interpolates ? interpolated : held)(master.dof) +=
          master.factor * node.weight;
    interpolated.compress(VectorOperation::add);
    held.compress(VectorOperation::add);
    for (LipNode<dim> &node : nodes)
      {
        node.weight += interpolated(node.dof);
        node.held_weight = held(node.dof);
      }
  }



  template <int dim>
  void
  ContactBoundary<dim>::spread_to_held_nodes(Vector &values) const
  {
    values.update_ghost_values();
    for (const HeldNode &node : held_nodes)
      {
        double value = 0.;
        for (const MasterNode &master : node.masters)
          value += master.factor * values(master.dof);
        values(node.dof) = value;
      }
    values.update_ghost_values();
  }



  template <int dim>
  void
  ContactBoundary<dim>::gather_from_held_nodes(Vector &values) const
  {
    values.zero_out_ghost_values();
    for (const HeldNode &node : held_nodes)
      {
        for (const MasterNode &master : node.masters)
          values(master.dof) += master.factor * values(node.dof);
        values(node.dof) = 0.;
      }
    values.compress(VectorOperation::add);
  }



  template <int dim>
  double
  ContactBoundary<dim>::gap_at(const Point<dim> &point) const
  {
    const double value = gap.value(point);
    if (value > rounding)
      throw SceneError("[Boundary] Gap = " + gap.formula() + ": is " +
                       Text::from_number(value, 6) + " at " +
                       Text::from_point(point) +
                       "; it must be at most 0 (an initial opening is "
                       "negative).");
    return std::min(value, 0.);
  }



  template class ContactBoundary<2>;
  template class ContactBoundary<3>;
} // namespace Crevasse
