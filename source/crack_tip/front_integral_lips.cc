// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

// The parts of FrontIntegral for the lips.

#include <crevasse/crack_tip/front_integral.h>

namespace Crevasse
{
  using namespace dealii;

  void
  FrontIntegral::add_lip_point(const FEFaceValues<3> &values,
                               const unsigned int     q,
                               const std::vector<types::global_dof_index> &dofs,
                               LipSums                                    &sums)
  {
    const auto              &cell  = values.get_cell();
    const unsigned int       f     = values.get_face_number();
    const types::boundary_id id    = cell->face(f)->boundary_id();
    const Point<3>          &point = values.quadrature_point(q);
    const auto              &fe    = body.space.finite_element;
    FrontFrame               frame = region.curve.frame(point);
    if (frame.X >= 0. || std::abs(frame.Y) > 1e-8 * cell->diameter())
      return;
    const double side =
      std::copysign(1., (cell->center() - point) * frame.inward);
    frame.Y                  = std::copysign(0., side);
    const Tensor<1, 3> u     = fields.displacement(frame);
    const double       share = fields.weight.factor(frame.X)[0] * values.JxW(q);
    // displacement in outward traction
    const Tensor<1, 3>    traction = -side * share * u;
    SymmetricTensor<2, 3> local;
    for (unsigned int i = 0; i < 3; ++i)
      local[i][1] = (i == 1 ? 1. : 0.5) * traction[i];
    const bool         is_loaded = body.space.roles.loaded.count(id) > 0;
    const Tensor<1, 3> of_contact =
      fields.mode == CrackMode::opening
        ? Tensor<1, 3>({traction[1], 0., 0.})
        : traction[0] * frame.ahead + traction[2] * frame.tangent;
    for (const auto &hat : region.hats(frame))
      {
        if (is_loaded)
          loaded.push_back({hat.vertex,
                            id,
                            point,
                            values.normal_vector(q),
                            hat.value * share *
                              (u[0] * frame.ahead + u[1] * frame.inward +
                               u[2] * frame.tangent)});
        sums.of_stress[hat.vertex] += hat.value * to_mesh(frame, local, 2.);
        if (n_tractions() > 0)
          for (const unsigned int i : values.dof_indices())
            if (fe.has_support_on_face(i, f))
              sums.of_traction[hat.vertex][dofs[i]] +=
                hat.value * values.shape_value(i, q) * of_contact;
      }
  }



  LipForces
  FrontIntegral::forces_at(const unsigned int                      vertex,
                           const unsigned int                      component,
                           const std::vector<FrontFrame>          &frames,
                           const std::vector<std::vector<double>> &factors,
                           const double                            reach) const
  {
    const FrontRegion::Vertex   &here  = region.vertices[vertex];
    const FrontCurve::Chain     &chain = region.curve.chains()[here.chain];
    std::vector<LipForces::Node> nodes;
    for (std::size_t i = 0; i < frames.size(); ++i)
      {
        const LipNode<3> &node  = body.lip.nodes[i];
        const FrontFrame &frame = frames[i];
        double            along = std::abs(frame.s - here.s);
        if (chain.is_closed)
          along = std::min(along, chain.length() - along);
        LipForces::Node lip{i, factors[0][i], -frame.X, along, node.weight, 1.};
        if (component > 0)
          {
            const double side = node.normal * frame.inward > 0. ? 1. : -1.;
            lip.factor        = 0.;
            for (unsigned int d = 0; d < 3; ++d)
              lip.factor +=
                side * node.tangents[component - 1][d] * factors[d][i];
            // The second tangent turns with the normal.
            lip.sign = component == 1 ? side : 1.;
          }
        if (lip.factor != 0. ||
            (frame.chain == here.chain && frame.X < 0. && frame.X > -reach &&
             along < reach && std::abs(frame.Y) < 1e-6 * region.cell_radius))
          nodes.push_back(lip);
      }
    // As at a tip in the plane.
    if (!region.curve.two_lips ||
        (fields.mode == CrackMode::opening && body.effects.viscosity.on))
      return LipForces(nodes);
    // The line begins elsewhere for the two tubes, of about 3 and 1.5 cells.
    return {nodes,
            1.5 * region.cell_radius + fields.weight.radius / 3.,
            reach,
            body.space.communicator()};
  }



  void
  FrontIntegral::keep_contact_forces(const LipSums &sums)
  {
    if (n_tractions() == 0)
      return;
    std::vector<FrontFrame> frames;
    for (const LipNode<3> &node : body.lip.nodes)
      frames.push_back(region.curve.frame(node.point));
    // Tubes are a few cells wide, so that the line is mostly beyond them.
    constexpr double part = 0.75, cells = 12.;
    const double     reach =
      std::min(part * region.curve.reach(), cells * region.cell_radius);
    Vector weights = body.space.ghosted_vector();
    for (unsigned int v = 0; v < sums.of_traction.size(); ++v)
      {
        std::vector<std::vector<double>> factors;
        for (unsigned int d = 0; d < n_tractions(); ++d)
          {
            weights = 0.;
            for (const auto &[dof, of_traction] : sums.of_traction[v])
              weights(dof) += of_traction[d];
            factors.push_back(body.lip.of_contact_forces(weights));
          }
        if (fields.mode == CrackMode::opening)
          of_contact_forces.push_back(
            {v, 0, forces_at(v, 0, frames, factors, reach)});
        else
          for (const unsigned int c : {1, 2})
            of_contact_forces.push_back(
              {v, c, forces_at(v, c, frames, factors, reach)});
      }
  }
} // namespace Crevasse
