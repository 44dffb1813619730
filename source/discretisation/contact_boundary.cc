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

#include <crevasse/discretisation/contact_boundary.h>
#include <crevasse/scene/problems.h>
#include <crevasse/scene/text.h>

#include <deal.II/base/mpi.h>
#include <deal.II/fe/fe_values.h>

#include <cmath>
#include <map>
#include <sstream>

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
      std::ostringstream message;
      message << "[Boundary] Contact: the face at " << Text::from_point(place)
              << " has the normal "
              << Text::from_point(Point<dim>(outward_normal))
              << ", but the crack lip must be parallel to a coordinate axis: "
                 "turn the mesh.";
      throw SceneError(message.str());
    }



    /** A constrained node of the lip must be held at zero. One that depends on
     * other unknowns, as on an inclined plane of symmetry, could penetrate
     * without anybody noticing. (In two dimensions no node of a boundary
     * hangs.) */
    template <int dim>
    void
    require_held(const Space<dim>             &space,
                 const types::global_dof_index dof,
                 const Point<dim>             &place)
    {
      const auto *entries = space.constraints().get_constraint_entries(dof);
      if (entries != nullptr && !entries->empty())
        throw SceneError(
          "[Boundary] Contact: the normal displacement of the lip's node at " +
          Text::from_point(place) +
          " is tied to another one by an inclined plane of symmetry, so that "
          "contact cannot be imposed there. Let the lip end elsewhere, or "
          "turn the mesh so that the plane is parallel to an axis.");
    }
  } // namespace



  template <int dim>
  ContactBoundary<dim>::ContactBoundary(const Space<dim> &space,
                                        Expression      &&gap_formula)
    : gap(std::move(gap_formula))
  {
    const FESystem<dim>  &fe = space.finite_element();
    FEFaceValues<dim>     values(space.mapping(),
                             fe,
                             space.face_quadrature(),
                             update_values | update_normal_vectors |
                               update_JxW_values | update_quadrature_points);
    const Quadrature<dim> support(fe.get_unit_support_points());
    FEValues<dim>         support_values(space.mapping(),
                                 fe,
                                 support,
                                 update_quadrature_points);

    // Weights are sums over the faces of all ranks that share a node; ghost
    // cells are visited too instead of communicating.
    std::map<types::global_dof_index, LipNode<dim>> nodes;
    std::vector<types::global_dof_index> indices(fe.n_dofs_per_cell());
    const IndexSet &owned = space.dof_handler().locally_owned_dofs();
    for (const auto &cell : space.dof_handler().active_cell_iterators())
      if (!cell->is_artificial() && cell->at_boundary())
        for (const unsigned int f : cell->face_indices())
          {
            const auto face = cell->face(f);
            if (!face->at_boundary() ||
                space.roles().contact.count(face->boundary_id()) == 0)
              continue;
            values.reinit(cell, f);
            support_values.reinit(cell);
            cell->get_dof_indices(indices);
            const auto [axis, sign] =
              inward_axis<dim>(values.normal_vector(0), face->center());
            for (unsigned int i = 0; i < fe.n_dofs_per_cell(); ++i)
              {
                if (fe.system_to_component_index(i).first != axis ||
                    !fe.has_support_on_face(i, f) ||
                    !owned.is_element(indices[i]))
                  continue;
                if (space.constraints().is_constrained(indices[i]))
                  {
                    require_held(space,
                                 indices[i],
                                 support_values.quadrature_point(i));
                    continue;
                  }
                LipNode<dim> &node = nodes[indices[i]];
                node.dof           = indices[i];
                node.component     = axis;
                node.sign          = sign;
                node.point         = support_values.quadrature_point(i);
                for (const unsigned int q : values.quadrature_point_indices())
                  node.weight +=
                    values.shape_value_component(i, q, axis) * values.JxW(q);
              }
          }

    for (auto &[dof, node] : nodes)
      {
        (void)dof;
        node.gap = gap_at(node.point);
        lip_nodes.push_back(node);
      }
  }



  template <int dim>
  double
  ContactBoundary<dim>::gap_at(const Point<dim> &point) const
  {
    double value;
    try
      {
        value = gap.value(point);
      }
    catch (const NumericalError &error)
      {
        // The gap is known before anything is computed.
        throw SceneError(std::string("[Boundary] Gap: ") + error.what());
      }
    if (value > 0.)
      {
        std::ostringstream message;
        message << "[Boundary] Gap = " << gap.formula() << ": is " << value
                << " at " << Text::from_point(point)
                << "; it must be at most 0 (an initial opening is negative).";
        throw SceneError(message.str());
      }
    return value;
  }



  template <int dim>
  const std::vector<LipNode<dim>> &
  ContactBoundary<dim>::nodes() const
  {
    return lip_nodes;
  }



  template class ContactBoundary<2>;
} // namespace Crevasse
