// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/problems.h>
#include <crevasse/base/text.h>
#include <crevasse/crack_tip/creep_integral.h>
#include <crevasse/discretisation/cell_values.h>

#include <set>

namespace Crevasse
{
  using namespace dealii;

  namespace
  {
    using Field = QuadratureField<2>;

    VoigtVector<2>
    creep_rate(const MaterialState<2> &material,
               const std::size_t       point,
               const VoigtVector<2>   &stress)
    {
      return (*material.creep)[point].rate(stress, {}, 1.).of_state /
             material.viscosity_factor;
    }



    /** Potential W = ∫ σ dε̇ᶜ and its derivative ∂W/∂X₁ at constant ε̇ᶜ, which
     * is −∂Ω/∂X₁ at constant stress (Legendre).
     *
     * @param of_law slopes of the constants of the law. */
    std::pair<double, double>
    potential(const MaterialState<2> &material,
              const std::size_t       point,
              const VoigtVector<2>   &stress,
              const VoigtVector<2>   &of_law)
    {
      const auto dual  = (*material.creep)[point].dual_potential(stress);
      double     slope = 0.;
      for (std::size_t i = 0; i < dual.slopes.size(); ++i)
        slope -= dual.slopes[i] * of_law[i];
      return {stress * creep_rate(material, point, stress) -
                dual.value / material.viscosity_factor,
              slope / material.viscosity_factor};
    }



    /** Strain rate without creep, ε̇ − ε̇ᶜ, at all points. */
    Vector
    other_strain_rate(const Body<2>          &body,
                      const MaterialState<2> &material,
                      const Vector           &stress,
                      const Vector           &velocity)
    {
      Vector rate;
      body.points.initialize(rate);
      body.strain_operator.for_each_strain(
        velocity, [&](const std::size_t offset, const VoigtVector<2> &strain) {
          Field::set(rate,
                     offset,
                     strain - creep_rate(material,
                                         offset / Field::n_components,
                                         Field::get(stress, offset)));
        });
      return rate;
    }



    /** Constants of the creep law at all points. */
    Vector
    describe_law(const Body<2> &body, const MaterialState<2> &material)
    {
      Vector law;
      body.points.initialize(law);
      for (std::size_t p = 0; p < body.points.n_local_points; ++p)
        {
          const CreepLaw::Constants &constants = (*material.creep)[p].constants;
          VoigtVector<2>             values;
          std::copy(constants.begin(), constants.end(), values.begin_raw());
          Field::set(law, p * Field::n_components, values);
        }
      return law;
    }



    /** Distance from the tip to another material than that of the cells at the
     * tip, or to another boundary; 0 if these cells have several materials. */
    double
    end_of_material(const TipRegion         &region,
                    const Space<2>          &space,
                    const StressRecovery<2> &recovery)
    {
      std::set<unsigned int> at_tip;
      for (const auto &cell : owned_cells(space.mesh()))
        if (region.reach(cell->active_cell_index()).first == 0.)
          at_tip.insert(recovery.material_of(cell));
      for (const auto &of_rank :
           Utilities::MPI::all_gather(space.communicator(), at_tip))
        at_tip.insert(of_rank.begin(), of_rank.end());
      double end = region.largest_radius();
      for (const auto &cell : owned_cells(space.mesh()))
        if (at_tip.count(recovery.material_of(cell)) == 0)
          end = std::min(end, region.reach(cell->active_cell_index()).first);
      return at_tip.size() > 1 ? 0.
                               : Utilities::MPI::min(end, space.communicator());
    }



    /** Weight q and its gradient ∇q at a point of the mesh. */
    std::pair<double, Tensor<1, 2>>
    weight_at(const SquareWeight &weight,
              const CrackTip     &tip,
              const Point<2>     &point)
    {
      const Point<2>     local = tip.local(point);
      const auto         f     = weight.factor(local[0]);
      const auto         g     = weight.factor(local[1]);
      const Tensor<1, 2> slope({f[1] * g[0], f[0] * g[1]});
      return {f[0] * g[0], tip.global(slope)};
    }
  } // namespace



  CreepIntegral::CreepIntegral(const Scene             &scene,
                               const Body<2>           &body,
                               const CrackTip          &tip,
                               const StressRecovery<2> &recovery)
    : body(body)
    , region(body.space, tip)
    , recovery(recovery)
    , points(body.space, body.points)
    , body_force(components_in_volume(scene.loads))
  {
    const double material_ends = end_of_material(region, body.space, recovery);
    if (material_ends == 0.)
      throw SceneError(
        "[Crack tip] Creep integral = true: the cells at the crack tip " +
        Text::from_point(tip.position) +
        " have different materials, so that the integral depends on the path. "
        "Set it to false.");
    const double size = region.square(scene.crack_tip.radius, material_ends);
    constexpr double rounding = 1e-10;
    if (size < 2. * region.cell_radius * (1. - rounding))
      throw SceneError(Text::format(
        "[Crack tip] Creep integral = true: the cells at the crack tip reach "
        "%g from it, but the square of the integral reaches %g instead of "
        "twice as far. Make these cells smaller ([Refinement] Strategy = tip), "
        "or change Radius.",
        region.cell_radius,
        size));
    double next = size;
    for (SquareWeight &weight : weights)
      {
        weight = region.weight(next);
        next   = region.aligned_radius(0.5 * size);
      }
  }



  std::vector<VoigtVector<2>>
  CreepIntegral::slopes(const Vector &field) const
  {
    const Space<2>             &space = body.space;
    const FiniteElement<2>     &nodes = recovery.dof_handler.get_fe();
    std::vector<VoigtVector<2>> slopes(points.location.size());
    FEValues<2>                 shapes(space.mapping,
                       nodes,
                       space.quadratures[0],
                       update_gradients);
    recovery.recover(
      field,
      [&](const auto &cell, const unsigned int i, const VoigtVector<2> &value) {
        if (!is_within(cell))
          return;
        if (i == 0)
          shapes.reinit(cell);
        const std::size_t first = body.points.first_point(cell);
        for (const unsigned int q : shapes.quadrature_point_indices())
          slopes[first + q] +=
            shapes.shape_grad(i, q) * region.tip.ahead * value;
      });
    return slopes;
  }



  CreepIntegral::Values
  CreepIntegral::evaluate(const double  t,
                          const Vector &stress,
                          const Vector &velocity) const
  {
    const Space<2>        &space    = body.space;
    const CrackTip        &tip      = region.tip;
    const MaterialState<2> material = body.material.at(t);
    const Vector rates    = other_strain_rate(body, material, stress, velocity);
    const auto   of_rates = slopes(rates);
    const auto   of_law   = material.creep->is_uniform()
                              ? std::vector<VoigtVector<2>>(of_rates.size())
                              : slopes(describe_law(body, material));
    const Vector nodal    = space.nodal_values(velocity);

    CellValues<2>             cell_values(space, update_gradients);
    std::vector<Tensor<2, 2>> gradients(space.quadratures[0].size());
    Values                    sums{};
    for (const auto &cell : owned_cells(space.dof_handler))
      {
        if (!is_within(cell))
          continue;
        const FEValues<2> &values = cell_values.reinit(cell);
        values[FEValuesExtractors::Vector(0)].get_function_gradients(nodal,
                                                                     gradients);
        const std::size_t first = body.points.first_point(cell);
        for (const unsigned int q : values.quadrature_point_indices())
          {
            const std::size_t    p = first + q;
            const VoigtVector<2> s =
              Field::get(stress, p * Field::n_components);
            const auto [W, slope_of_W] = potential(material, p, s, of_law[p]);
            const Tensor<1, 2> along = gradients[q] * tip.ahead; // slope u̇,₁
            const Tensor<1, 2> flux({s[0] * along[0] + s[3] * along[1],
                                     s[3] * along[0] + s[1] * along[1]});
            double             divergence = s * of_rates[p] - slope_of_W;
            if (space.roles.has_axis)
              {
                // Rings grow in radius as places move ahead: P of the hoops.
                const VoigtVector<2> rate =
                  Field::get(rates, p * Field::n_components) +
                  creep_rate(material, p, s);
                divergence +=
                  tip.ahead[0] / points.location[p][0] * (s[2] * rate[2] - W);
              }
            for (const auto &[d, force] : body_force)
              divergence -= force.value(points.location[p], t) * along[d];
            for (const unsigned int k : {0, 1})
              {
                const auto [weight, gradient] =
                  weight_at(weights[k], tip, points.location[p]);
                sums[k] +=
                  points.weight[p] *
                  (gradient * (flux - W * tip.ahead) + weight * divergence);
              }
          }
      }
    for (double &sum : sums)
      sum = (tip.two_lips ? 1. : 2.) /
            (space.roles.has_axis ? tip.position[0] : 1.) *
            Utilities::MPI::sum(sum, space.communicator());
    return sums;
  }
} // namespace Crevasse
