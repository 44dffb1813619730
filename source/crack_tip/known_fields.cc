// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/crack_tip/known_fields.h>
#include <crevasse/discretisation/cell_values.h>

namespace Crevasse
{
  using namespace dealii;

  namespace
  {
    // The stress of Williams' terms does not depend on κ: 2 means λ = μ.
    constexpr double kappa = 2.;
  } // namespace



  KnownFields::KnownFields(const Body<2> &body, const TipRegion &region)
  {
    none.normal.assign(body.lip.nodes.size(), 0.);
    // Singular functions of mode I are term 1, what completes it, and term 3:
    // terms beyond their number are not in the space.
    unsigned int n_singular = 0;
    if (const auto *shapes = body.space.singular_shapes())
      for (const SingularFunction &function : shapes->functions)
        n_singular += function.mode == CrackMode::opening &&
                      function.tip.position == region.tip.position;
    for (const unsigned int n : {1, 3, 4})
      if (n > n_singular)
        {
          PolarField field = williams_term(n, kappa);
          // The first term has K_I = √(2π).
          field *= std::pow(region.largest_radius(), 0.5 * (1. - n)) /
                   std::sqrt(2. * numbers::PI);
          fields.emplace_back(interpolated_stress(body, region, field),
                              n == 1 ? 1. : 0.);
        }
  }



  double
  KnownFields::error_of(const InteractionIntegral &integral,
                        const CrackMode            mode) const
  {
    double sum = 0.;
    for (const auto &[stress, K] : fields)
      sum += std::pow(integral.of_uniform_body(stress, none, kappa) -
                        (mode == CrackMode::opening ? K : 0.),
                      2);
    return std::sqrt(sum);
  }



  Vector
  KnownFields::interpolated_stress(const Body<2>    &body,
                                   const TipRegion  &region,
                                   const PolarField &field) const
  {
    const Space<2>           &space = body.space;
    const FESystem<2>        &fe    = space.finite_element;
    const Tensor<2, 2>        turn  = transpose(region.tip.to_local());
    std::vector<Tensor<1, 2>> nodal(fe.n_dofs_per_cell());
    CellValues<2>             cell_values(space, update_gradients);
    Vector                    stress;
    body.points.initialize(stress);
    for (const auto &cell : owned_cells(space.dof_handler))
      {
        if (!region.overlaps(cell->active_cell_index(),
                             region.largest_radius()))
          continue;
        for (unsigned int i = 0; i < nodal.size(); ++i)
          nodal[i] =
            turn * field.displacement(
                     region.tip.local(space.mapping.transform_unit_to_real_cell(
                                        cell, fe.unit_support_point(i)),
                                      cell->center()));
        const FEValues<2> &values = cell_values.reinit(cell);
        for (const unsigned int q : values.quadrature_point_indices())
          {
            Tensor<2, 2> gradient;
            for (unsigned int i = 0; i < nodal.size(); ++i)
              {
                const unsigned int c = fe.system_to_component_index(i).first;
                gradient[c] += nodal[i][c] * values.shape_grad(i, q);
              }
            const double   mean = 0.5 * trace(gradient);
            VoigtVector<2> s;
            s[0] = gradient[0][0] + mean;
            s[1] = gradient[1][1] + mean;
            s[3] = 0.5 * (gradient[0][1] + gradient[1][0]);
            QuadratureField<2>::set(stress,
                                    (body.points.first_point(cell) + q) *
                                      QuadratureField<2>::n_components,
                                    s);
          }
      }
    return stress;
  }
} // namespace Crevasse
