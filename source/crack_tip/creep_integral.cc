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
    template <int dim>
    VoigtVector<dim>
    creep_rate(const MaterialState<dim> &material,
               const std::size_t         point,
               const VoigtVector<dim>   &stress)
    {
      return (*material.creep)[point].rate(stress, {}, 1.).of_state /
             material.viscosity_factor;
    }



    /** Potential W = ∫ σ dε̇ᶜ and its derivative ∂W/∂X₁ at constant ε̇ᶜ, which
     * is −∂Ω/∂X₁ at constant stress (Legendre).
     *
     * @param of_law slopes of the constants of the law. */
    template <int dim>
    std::pair<double, double>
    potential(const MaterialState<dim> &material,
              const std::size_t         point,
              const VoigtVector<dim>   &stress,
              const VoigtVector<dim>   &of_law)
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
    template <int dim>
    Vector
    other_strain_rate(const Body<dim>          &body,
                      const MaterialState<dim> &material,
                      const Vector             &stress,
                      const Vector             &velocity)
    {
      using Field = QuadratureField<dim>;
      Vector rate;
      body.points.initialize(rate);
      body.strain_operator.for_each_strain(
        velocity,
        [&](const std::size_t offset, const VoigtVector<dim> &strain) {
          Field::set(rate,
                     offset,
                     strain - creep_rate(material,
                                         offset / Field::n_components,
                                         Field::get(stress, offset)));
        });
      return rate;
    }



    /** Constants of the creep law at all points. */
    template <int dim>
    Vector
    describe_law(const Body<dim> &body, const MaterialState<dim> &material)
    {
      Vector law;
      body.points.initialize(law);
      for (std::size_t p = 0; p < body.points.n_local_points; ++p)
        {
          const CreepLaw::Constants &constants = (*material.creep)[p].constants;
          VoigtVector<dim>           values;
          std::copy(constants.begin(), constants.end(), values.begin_raw());
          QuadratureField<dim>::set(law,
                                    p * QuadratureField<dim>::n_components,
                                    values);
        }
      return law;
    }



    /** Distance from the tip or front to another material than that of the
     * cells there, or to another boundary; 0 if these cells have several
     * materials. */
    template <int dim>
    double
    end_of_material(const SquareRegion        &region,
                    const Space<dim>          &space,
                    const StressRecovery<dim> &recovery)
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
  } // namespace



  template <int dim>
  CreepIntegral<dim>::CreepIntegral(const Scene               &scene,
                                    const Body<dim>           &body,
                                    const Region              &region,
                                    const StressRecovery<dim> &recovery)
    : body(body)
    , region(region)
    , recovery(recovery)
    , body_force(components_in_volume(scene.loads))
    , ahead(body.points.n_local_points)
  {
    const double material_ends = end_of_material(region, body.space, recovery);
    if (material_ends == 0.)
      throw SceneError(
        "[Crack tip] Creep integral = true: the cells at the " + name() +
        " have different materials, so that the integral depends on the path. "
        "Set it to false.");
    const double size = region.square(scene.crack_tip.radius, material_ends);
    constexpr double rounding = 1e-10;
    if (size < 2. * region.cell_radius * (1. - rounding))
      throw SceneError(Text::format(
        "[Crack tip] Creep integral = true: the cells at the %s reach "
        "%g from it, but the square of the integral reaches %g instead of "
        "twice as far. Make these cells smaller ([Refinement] Strategy = tip), "
        "or change Radius.",
        name().c_str(),
        region.cell_radius,
        size));
    double next = size;
    for (SquareWeight &weight : weights)
      {
        weight = region.weight(next);
        next   = region.aligned_radius(0.5 * size);
      }
    find_places();
  }



  template <int dim>
  template <typename Cell>
  bool
  CreepIntegral<dim>::is_within(const Cell &cell) const
  {
    if constexpr (dim == 2)
      return region.overlaps(cell->active_cell_index(), radius());
    else
      return region.is_near(cell, radius());
  }



  template <int dim>
  void
  CreepIntegral<dim>::find_places()
  {
    CellValues<dim> cell_values(body.space,
                                update_quadrature_points | update_JxW_values);
    for (const auto &cell : owned_cells(body.space.dof_handler))
      if (is_within(cell))
        {
          const FEValues<dim> &values = cell_values.reinit(cell);
          const std::size_t    first  = body.points.first_point(cell);
          for (const unsigned int q : values.quadrature_point_indices())
            {
              const Point<dim> location = values.quadrature_point(q);
              Place place{first + q, values.JxW(q), location, {}, {}};
              if constexpr (dim == 2)
                {
                  place.frame = region.frame(region.tip.local(location));
                  place.hats  = {{{0, 1., 0.}, {0, 0., 0.}}};
                }
              else
                {
                  place.frame = region.curve.frame(location);
                  place.hats  = region.hats(place.frame);
                }
              if (std::max(std::abs(place.frame.X), std::abs(place.frame.Y)) >=
                  radius())
                continue;
              for (unsigned int d = 0; d < dim; ++d)
                ahead[place.point][d] = place.frame.ahead[d];
              places.push_back(place);
            }
        }
  }



  template <int dim>
  std::vector<VoigtVector<dim>>
  CreepIntegral<dim>::slopes(const Vector &field) const
  {
    const Space<dim>             &space = body.space;
    const FiniteElement<dim>     &nodes = recovery.dof_handler.get_fe();
    std::vector<VoigtVector<dim>> slopes(ahead.size());
    FEValues<dim>                 shapes(space.mapping,
                         nodes,
                         space.quadratures[0],
                         update_gradients);
    recovery.recover(field,
                     [&](const auto             &cell,
                         const unsigned int      i,
                         const VoigtVector<dim> &value) {
                       if (!is_within(cell))
                         return;
                       if (i == 0)
                         shapes.reinit(cell);
                       const std::size_t first = body.points.first_point(cell);
                       for (const unsigned int q :
                            shapes.quadrature_point_indices())
                         slopes[first + q] +=
                           shapes.shape_grad(i, q) * ahead[first + q] * value;
                     });
    return slopes;
  }



  template <int dim>
  void
  CreepIntegral<dim>::add(const Place         &place,
                          const State         &state,
                          std::vector<Values> &sums) const
  {
    const FrontFrame  &frame  = place.frame;
    const double       metric = frame.metric();
    const Tensor<1, 3> flux   = frame.ahead * state.P;
    // Work of P on the front's change of length as it moves ahead.
    const double growth =
      frame.curvature / metric * (frame.tangent * state.P * frame.tangent);
    for (const unsigned int k : {0, 1})
      {
        const auto   f = weights[k].factor(frame.X);
        const auto   g = weights[k].factor(frame.Y);
        const double Q = f[0] * g[0];
        const double of_value =
          (f[1] * g[0] * frame.ahead + f[0] * g[1] * frame.inward) * flux +
          Q * (state.divergence + growth);
        const double of_slope = Q / metric * (frame.tangent * flux);
        for (const auto &hat : place.hats)
          sums[hat.vertex][k] +=
            place.weight * (hat.value * of_value + hat.slope * of_slope);
      }
  }



  template <int dim>
  void
  CreepIntegral<dim>::normalise(std::vector<Values> &sums) const
  {
    for (const unsigned int k : {0, 1})
      {
        std::vector<double> C;
        for (const Values &sum : sums)
          C.push_back(sum[k]);
        Utilities::MPI::sum(C, body.space.communicator(), C);
        if constexpr (dim == 2)
          C[0] *= (region.tip.two_lips ? 1. : 2.) /
                  (body.space.roles.has_axis ? region.tip.position[0] : 1.);
        else
          {
            for (std::size_t v = 0; v < C.size(); ++v)
              C[v] *= (region.curve.two_lips ? 1. : 2.) /
                      region.vertices[v].integral();
            C = region.values_of_means(C);
          }
        for (std::size_t v = 0; v < C.size(); ++v)
          sums[v][k] = C[v];
      }
  }



  template <int dim>
  std::vector<typename CreepIntegral<dim>::Values>
  CreepIntegral<dim>::evaluate(const double  t,
                               const Vector &stress,
                               const Vector &velocity) const
  {
    using Field                       = QuadratureField<dim>;
    const Space<dim>        &space    = body.space;
    const MaterialState<dim> material = body.material.at(t);
    const Vector rates    = other_strain_rate(body, material, stress, velocity);
    const auto   of_rates = slopes(rates);
    const auto   of_law   = material.creep->is_uniform()
                              ? std::vector<VoigtVector<dim>>(of_rates.size())
                              : slopes(describe_law(body, material));
    const Vector nodal    = space.nodal_values(velocity);

    CellValues<dim>             cell_values(space, update_gradients);
    std::vector<Tensor<2, dim>> gradients(space.quadratures[0].size());
    std::vector<Values>         sums(n_values());
    auto                        place = places.begin();
    for (const auto &cell : owned_cells(space.dof_handler))
      {
        const std::size_t first = body.points.first_point(cell);
        const std::size_t end   = first + space.quadrature(cell).size();
        if (place == places.end() || place->point >= end)
          continue;
        cell_values.reinit(cell)[FEValuesExtractors::Vector(0)]
          .get_function_gradients(nodal, gradients);
        for (; place != places.end() && place->point < end; ++place)
          {
            const std::size_t      p = place->point;
            const VoigtVector<dim> s =
              Field::get(stress, p * Field::n_components);
            const auto [W, slope_of_W] = potential(material, p, s, of_law[p]);
            const Tensor<2, dim> &rate = gradients[p - first];
            Tensor<2, 3>          of_velocity;
            for (unsigned int i = 0; i < dim; ++i)
              for (unsigned int j = 0; j < dim; ++j)
                of_velocity[i][j] = rate[i][j];
            if (space.roles.has_axis)
              of_velocity[2][2] = (Field::get(rates, p * Field::n_components) +
                                   creep_rate(material, p, s))[2];
            State                state{transpose(of_velocity) *
                            Tensor<2, 3>(stress_tensor<dim>(s)) -
                          W * Tensor<2, 3>(unit_symmetric_tensor<3>()),
                        s * of_rates[p] - slope_of_W};
            const Tensor<1, dim> along = rate * ahead[p]; // slope u̇,₁
            for (const auto &[d, force] : body_force)
              state.divergence -= force.value(place->location, t) * along[d];
            add(*place, state, sums);
          }
      }
    normalise(sums);
    return sums;
  }



  template <int dim>
  std::string
  CreepIntegral<dim>::name() const
  {
    if constexpr (dim == 2)
      return "crack tip " + Text::from_point(region.tip.position);
    else
      return "crack front";
  }



  template <int dim>
  std::string
  CreepIntegral<dim>::describe() const
  {
    return name() +
           (dim == 2 ? "" : ", " + std::to_string(n_values()) + " vertices") +
           Text::format(", C(t) over squares with half sides of %g and %g",
                        weights[0].radius,
                        weights[1].radius);
  }



  template class CreepIntegral<2>;
  template class CreepIntegral<3>;
} // namespace Crevasse
