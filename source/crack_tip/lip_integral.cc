// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/crack_tip/lip_integral.h>

namespace Crevasse
{
  using namespace dealii;

  namespace
  {
    /** Quadrature rule on a face of the lip with the weight 1/√r, exact for the
     * polynomials that occur: r = s² makes the integrand smooth. */
    Quadrature<1>
    inverse_root_rule(const double r_0, const double r_1)
    {
      const QGauss<1>       gauss(8);
      const double          s_0 = std::sqrt(r_0), s_1 = std::sqrt(r_1);
      std::vector<Point<1>> nodes;
      std::vector<double>   weights;
      for (unsigned int k = 0; k < gauss.size(); ++k)
        {
          const double s = s_0 + gauss.point(k)[0] * (s_1 - s_0);
          nodes.emplace_back((s * s - r_0) / (r_1 - r_0));
          weights.push_back(gauss.weight(k) * 2. * (s_1 - s_0) / (r_1 - r_0));
        }
      return Quadrature<1>(nodes, weights);
    }



    /** Coordinates of a point of a lip: a straight one is on the negative axis,
     * on the side of its cell. */
    Point<2>
    local_of(const TipRegion &region,
             const Point<2>  &point,
             const Point<2>  &center)
    {
      return region.has_bends() ? region.tip.local(point)
                                : region.tip.local(point, center);
    }



    /** Calls f(cell, face number, values, √r of the points) for this rank's
     * faces on the lips of a tip, with values for the weight 1/√r. */
    template <typename Function>
    void
    for_each_face(const Space<2>  &space,
                  const TipRegion &region,
                  const double     size,
                  const Function  &f)
    {
      const CrackTip &tip = region.tip;
      for (const auto &cell : owned_cells(space.dof_handler))
        for (const unsigned int face : cell->face_indices())
          {
            if (!cell->at_boundary(face) ||
                !space.roles.is_lip(cell->face(face)->boundary_id()))
              continue;
            const Point<2> a   = tip.local(cell->face(face)->vertex(0));
            const Point<2> b   = tip.local(cell->face(face)->vertex(1));
            const double   r_a = -a[0], r_b = -b[0];
            // Faces of other lips do not count.
            if (!region.is_of_tip(a, b) || r_a + r_b <= 0. ||
                std::min(r_a, r_b) >= size)
              continue;
            // The root of what rounding leaves of 0 would not be small.
            const double        tiny  = 1e-10 * (r_a + r_b);
            const double        begin = r_a > tiny ? r_a : 0.;
            const double        end   = r_b > tiny ? r_b : 0.;
            const Quadrature<1> rule  = inverse_root_rule(begin, end);
            std::vector<double> roots;
            for (const Point<1> &node : rule.get_points())
              roots.push_back(std::sqrt(begin + node[0] * (end - begin)));
            FEFaceValues<2> values(space.mapping,
                                   space.finite_element,
                                   rule,
                                   update_values | update_quadrature_points |
                                     update_JxW_values | update_normal_vectors);
            values.reinit(cell, face);
            f(cell, face, values, roots);
          }
    }
  } // namespace



  LipForces
  lip_integral(const Body<2>      &body,
               const TipRegion    &region,
               const SquareWeight &weight,
               const bool          is_smooth)
  {
    const CrackTip                      &tip = region.tip;
    const FESystem<2>                   &fe  = body.space.finite_element;
    std::vector<types::global_dof_index> dofs(fe.n_dofs_per_cell());
    Vector       per_pressure = body.space.ghosted_vector();
    const double factor = tip.two_lips ? 1. : 2.; // two equal lips, or one
    for_each_face(body.space,
                  region,
                  weight.radius,
                  [&](const auto        &cell,
                      const unsigned int f,
                      const auto        &values,
                      const auto &) {
                    cell->get_dof_indices(dofs);
                    for (const unsigned int i : values.dof_indices())
                      if (fe.has_support_on_face(i, f))
                        for (const unsigned int q :
                             values.quadrature_point_indices())
                          per_pressure(dofs[i]) +=
                            factor / std::sqrt(2. * numbers::PI) *
                            values.shape_value(i, q) *
                            weight.factor(
                              tip.local(values.quadrature_point(q))[0])[0] *
                            values.JxW(q);
                  });
    const std::vector<double> factors =
      body.lip.of_contact_forces(per_pressure);
    std::vector<LipForces::Node> nodes;
    for (std::size_t i = 0; i < factors.size(); ++i)
      if (factors[i] != 0.)
        {
          const LipNode<2> &node = body.lip.nodes[i];
          nodes.push_back(
            {i, factors[i], -tip.local(node.point)[0], 0., node.weight, 1.});
        }
    if (!is_smooth || !tip.two_lips)
      return LipForces(nodes); // one lip has a mirrored mesh
    // Where cells grow with the distance, so does the error over all of them.
    return {nodes,
            2. * region.cell_radius + weight.radius / 64.,
            weight.radius,
            body.space.communicator()};
  }



  std::vector<LipPoint>
  lip_points(const Space<2> &space, const TipRegion &region, const double size)
  {
    const CrackTip       &tip = region.tip;
    std::vector<LipPoint> points;
    for_each_face(
      space,
      region,
      size,
      [&](const auto        &cell,
          const unsigned int f,
          const auto        &values,
          const auto        &roots) {
        for (const unsigned int q : values.quadrature_point_indices())
          {
            const Point<2> &point = values.quadrature_point(q);
            const Point<2>  local = local_of(region, point, cell->center());
            points.push_back(
              {cell->face(f)->boundary_id(),
               point,
               local,
               values.normal_vector(q),
               roots[q] * values.JxW(q),
               region.sign_of_root(tip.local(cell->center()), local)});
          }
      });
    return points;
  }



  Vector
  lip_work(const Space<2>                                      &space,
           const TipRegion                                     &region,
           const double                                         size,
           const std::function<Tensor<1, 2>(const LipPoint &)> &force)
  {
    const FESystem<2>                   &fe = space.finite_element;
    std::vector<types::global_dof_index> dofs(fe.n_dofs_per_cell());
    Vector                               work = space.ghosted_vector();
    for_each_face(
      space,
      region,
      size,
      [&](const auto        &cell,
          const unsigned int f,
          const auto        &values,
          const auto        &roots) {
        cell->get_dof_indices(dofs);
        for (const unsigned int q : values.quadrature_point_indices())
          {
            const Point<2>    &point = values.quadrature_point(q);
            const Point<2>     local = local_of(region, point, cell->center());
            const Tensor<1, 2> t     = force(
              {cell->face(f)->boundary_id(),
                   point,
                   local,
                   values.normal_vector(q),
                   roots[q] * values.JxW(q),
                   region.sign_of_root(region.tip.local(cell->center()), local)});
            for (const unsigned int i : values.dof_indices())
              work(dofs[i]) += values.shape_value(i, q) *
                               t[fe.system_to_component_index(i).first];
          }
      });
    return work;
  }
} // namespace Crevasse
