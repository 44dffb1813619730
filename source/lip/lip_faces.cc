// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/collectively.h>
#include <crevasse/grid/mesh.h>
#include <crevasse/lip/lip_faces.h>

#include <deal.II/fe/fe_values.h>
#include <deal.II/numerics/rtree.h>

#include <algorithm>
#include <boost/serialization/array.hpp>
#include <boost/serialization/vector.hpp>
#include <numeric>

namespace Crevasse
{
  using namespace dealii;

  namespace
  {
    /** Contributions of the nodes of a face whose values are computed. */
    template <int dim>
    std::vector<typename LipFace<dim>::Node>
    nodes_of(const FEFaceValues<dim>                    &face,
             const FEValues<dim>                        &support,
             const std::vector<types::global_dof_index> &dofs,
             const bool                                  has_axis)
    {
      const FiniteElement<dim>                &fe = face.get_fe();
      std::vector<typename LipFace<dim>::Node> nodes;
      for (unsigned int i = 0; i < dofs.size(); ++i)
        if (fe.system_to_component_index(i).first == 0 &&
            fe.has_support_on_face(i, face.get_face_number()))
          {
            typename LipFace<dim>::Node node{
              dofs[i], support.quadrature_point(i), 0., {}, {}};
            for (const unsigned int q : face.quadrature_point_indices())
              {
                const double share =
                  face.shape_value_component(i, q, 0) * face.JxW(q);
                const double radius = face.quadrature_point(q)[0];
                const bool   on_axis =
                  has_axis && node.point[0] < LipFace<dim>::tolerance * radius;
                node.area += share;
                node.load -= share * face.normal_vector(q);
                node.inward -=
                  (on_axis ? share / radius : share) * face.normal_vector(q);
              }
            nodes.push_back(node);
          }
      return nodes;
    }
  } // namespace



  template <int dim>
  std::vector<LipFace<dim>>
  find_lip_faces(const DoFHandler<dim>     &dof_handler,
                 const Mapping<dim>        &mapping,
                 const Quadrature<dim - 1> &rule,
                 const BoundaryRoles       &roles)
  {
    if (!roles.has_contact())
      return {};
    const FiniteElement<dim>            &fe = dof_handler.get_fe();
    FEFaceValues<dim>                    values(mapping,
                             fe,
                             rule,
                             update_values | update_normal_vectors |
                               update_JxW_values | update_quadrature_points);
    FEValues<dim>                        support(mapping,
                          fe,
                          Quadrature<dim>(fe.get_unit_support_points()),
                          update_quadrature_points);
    std::vector<types::global_dof_index> dofs(fe.n_dofs_per_cell());
    std::vector<LipFace<dim>>            faces;
    for (const auto &cell : owned_cells(dof_handler))
      for (const unsigned int f : cell->face_indices())
        if (const auto face = cell->face(f);
            face->at_boundary() && roles.touches(face->boundary_id()))
          {
            values.reinit(cell, f);
            support.reinit(cell);
            cell->get_dof_indices(dofs);
            const auto   cell_id = cell->id().template to_binary<dim>();
            LipFace<dim> mine{
              {{cell_id[0], cell_id[1], cell_id[2], cell_id[3], f}},
              face->center(),
              face->diameter(),
              roles.crack.count(face->boundary_id()) > 0,
              nodes_of<dim>(values, support, dofs, roles.has_axis)};
            faces.push_back(mine);
          }

    auto all = of_all_ranks(dof_handler.get_communicator(), faces);
    std::sort(all.begin(),
              all.end(),
              [](const LipFace<dim> &a, const LipFace<dim> &b) {
                return a.id < b.id;
              });
    return all;
  }



  template <int dim>
  std::vector<unsigned int>
  find_partners(const std::vector<Point<dim>> &points,
                const std::vector<double>     &sizes)
  {
    std::vector<unsigned int> partner(points.size());
    std::iota(partner.begin(), partner.end(), 0);
    const auto tree = pack_rtree_of_indices(points);
    for (unsigned int i = 0; i < points.size(); ++i)
      for (const auto j :
           tree | boost::geometry::index::adaptors::queried(
                    boost::geometry::index::nearest(points[i], 2)))
        if (j != i &&
            points[i].distance(points[j]) <= LipFace<dim>::tolerance * sizes[i])
          partner[i] = j;
    return partner;
  }



  template decltype(find_lip_faces<2>) find_lip_faces<2>;
  template decltype(find_lip_faces<3>) find_lip_faces<3>;
  template decltype(find_partners<2>)  find_partners<2>;
  template decltype(find_partners<3>)  find_partners<3>;
} // namespace Crevasse
