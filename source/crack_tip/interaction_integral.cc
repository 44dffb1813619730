// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/problems.h>
#include <crevasse/crack_tip/front_field.h>
#include <crevasse/crack_tip/interaction_integral.h>
#include <crevasse/crack_tip/kernel_rules.h>
#include <crevasse/material/voigt_matrix.h>

namespace Crevasse
{
  using namespace dealii;

  namespace
  {
    /** In-plane strain caused by a stress, and by a strain without stress
     * across the plane. */
    struct PlaneCompliance
    {
      PlaneCompliance(const VoigtMatrix<2> &K, const bool has_hoops)
        : of_stress(inverse<2>(has_hoops ? K : in_plane<2>(K)))
      {
        if (has_hoops)
          return;
        VoigtVector<2> column;
        for (const unsigned int c : {0, 1, 3})
          column[c] = K[c][2];
        of_third = of_stress * column;
      }

      VoigtVector<2>
      free_strain(const VoigtVector<2> &e) const
      {
        return e + e[2] * of_third;
      }

      VoigtMatrix<2> of_stress;
      VoigtVector<2> of_third;
    };



    /** Weights of the squares whose τ multiplies viscous strain, each with its
     * factor. */
    std::vector<std::pair<SquareWeight, double>>
    weights_of_creep(const TipRegion                    &region,
                     const InteractionIntegral::Squares &squares)
    {
      const double a = squares.creep;
      if (a >= squares.size)
        return {};
      if (!squares.extrapolates)
        return {{region.weight(squares.size), 1.}, {region.weight(a), -1.}};
      return {{region.weight(squares.size), 1.},
              {region.weight(a), -2.},
              {region.weight(2. * a), 1.}};
    }
  } // namespace



  InteractionIntegral::InteractionIntegral(const Body<2>        &body,
                                           const PointGeometry  &points,
                                           const TipRegion      &region,
                                           const CrackMode       mode,
                                           const LoadParameters &loads,
                                           const Squares        &squares)
    : body(body)
    , points(points)
    , region(region)
    , mode(mode)
    , kappa_of_ring(squares.kappa_of_ring)
    , anisotropic(squares.anisotropic)
    , interface(squares.interface)
    , is_closed(squares.is_closed)
    , loads(loads)
    , body_force(components_in_volume(loads))
    , of_contact_forces(!region.has_bends() && interface == nullptr &&
                            (mode == CrackMode::opening ||
                             (mode == CrackMode::sliding && body.friction))
                          ? lip_integral(body,
                                         region,
                                         region.weight(squares.size),
                                         mode == CrackMode::sliding ||
                                           !body.effects.viscosity.on)
                          : LipForces())
  {
    if (kappa_of_ring > 0.)
      of_contact_forces.scale(1. / region.tip.position[0]);
    if (region.has_bends() || interface != nullptr)
      integrate_over_bends(squares.size);
    integrate_over_cells(squares);
    balance(integrate_over_lips(squares.size), squares.size);
  }



  AuxiliaryField
  InteractionIntegral::field_at(const Point<2>     &local,
                                const SquareWeight &weight) const
  {
    if (anisotropic != nullptr)
      return anisotropic->auxiliary(region.tip, mode, local, weight);
    if (interface != nullptr)
      return interface->auxiliary(region.tip, mode, local, weight, is_closed);
    AuxiliaryField field;
    if (kappa_of_ring == 0.)
      { // without the weight x of rings, if there are any
        const double x = region.tip.position[0] + region.tip.global(local)[0];
        field.add(body.space.roles.has_axis ? 1. / x : 1.,
                  AuxiliaryField(region.tip, mode, local, weight));
        return field;
      }
    const double      nu = (3. - kappa_of_ring) / 4.;
    const FrontFields fields{mode, region.tip.two_lips, {1., nu}, weight};
    const FrontField  of_front = fields.at(region.frame(local)).first;
    const double      share    = 1. / region.tip.position[0];
    const double      of_kappa = (kappa_of_ring + 1.) / 4. * share;
    for (unsigned int c = 0; c < QuadratureField<2>::n_components; ++c)
      {
        field.of_stress[0][c] = of_kappa * of_front.of_stress[c];
        field.of_strain[c] =
          share / fields.elasticity.modulus(mode) * of_front.of_strain[c];
      }
    for (const unsigned int d : {0, 1})
      field.of_force[0][d] = of_kappa * of_front.of_force[d];
    return field;
  }



  VoigtVector<2>
  InteractionIntegral::strain_on_rings(const VoigtVector<2> &stress) const
  {
    const double   nu    = (3. - kappa_of_ring) / 4.;
    const double   trace = stress[0] + stress[1] + stress[2];
    VoigtVector<2> strain;
    for (unsigned int d = 0; d < 3; ++d)
      strain[d] = (kappa_of_ring + 1.) / 4. / (1. - nu * nu) *
                  ((1. + nu) * stress[d] - nu * trace);
    return strain;
  }



  double
  InteractionIntegral::hoops_at(const Point<2>     &local,
                                const SquareWeight &weight) const
  {
    const double nu = (3. - kappa_of_ring) / 4.;
    return weight.factor(local[0])[0] * weight.factor(local[1])[0] * 2. * nu *
           BuecknerField(local, mode, region.tip.two_lips).mean /
           region.tip.position[0];
  }



  void
  InteractionIntegral::integrate_over_cells(const Squares &squares)
  {
    const std::vector<std::pair<SquareWeight, double>> of_creep =
      weights_of_creep(region, squares);
    has_creep                = !of_creep.empty();
    const SquareWeight whole = region.weight(squares.size);
    Point<2>           center;
    const auto         add = [&](Kernel         &kernel,
                         const Point<2> &point,
                         const double    of_point) {
      const Point<2> local = region.tip.local(point);
      if (local.norm() == 0.)
        return; // by rounding, in tiny cells
      const double share    = of_point * sign(center, local);
      const auto   field_of = [&](const SquareWeight &weight) {
        return field_at(local, weight);
      };
      kernel.field.add(share, field_of(whole));
      if (kappa_of_ring > 0. && mode == CrackMode::constant)
        of_hoops += share * hoops_at(local, whole);
      for (const auto &[weight, factor] : of_creep)
        kernel.of_viscous_strain += share * factor * field_of(weight).of_strain;
    };
    const Space<2> &space = body.space;
    using Rules           = KernelRules<2>;
    Rules rules(space,
                QGauss<2>(Rules::points_per_direction(space) + 4),
                Quadrature<2>(crowded_rule(40)));
    for (const auto &cell : owned_cells(space.mesh()))
      {
        const unsigned int index = cell->active_cell_index();
        if (!region.overlaps(index, squares.size))
          continue;
        center                    = region.tip.local(cell->center());
        const std::size_t   first = body.points.first_point(cell);
        std::vector<Kernel> of_cell(space.quadrature(cell).size());
        for (unsigned int p = 0; p < of_cell.size(); ++p)
          of_cell[p].point = first + p;
        const bool is_at_tip = region.reach(index).first == 0.;
        if (space.rule(cell) != 0)
          for (Kernel &kernel : of_cell)
            {
              const double area = points.weight[kernel.point];
              add(kernel, points.location[kernel.point], area);
              kernel.of_limit = is_at_tip ? area / cell->measure() : 0.;
            }
        else
          {
            if (is_at_tip)
              for (unsigned int p = 0; p < of_cell.size(); ++p)
                of_cell[p].of_limit = rules.limit(cell, p, region.tip.position);
            const FEValues<2> &values = rules.reinit(cell, is_at_tip);
            for (const unsigned int q : values.quadrature_point_indices())
              {
                Kernel here;
                add(here, values.quadrature_point(q), values.JxW(q));
                for (unsigned int p = 0; p < of_cell.size(); ++p)
                  of_cell[p].add(values.shape_value(p, q), here);
              }
          }
        kernels.insert(kernels.end(), of_cell.begin(), of_cell.end());
      }
  }



  double
  InteractionIntegral::of_forces(const double t, const double kappa) const
  {
    double sum = 0.;
    for (const auto &[place, field] : loaded)
      sum += (field.of_force[0] + kappa * field.of_force[1]) *
             surface_force<2>(loads, place.id, place.point, place.normal, t);
    for (const auto &[d, force] : body_force)
      for (const Kernel &kernel : kernels)
        sum +=
          (kernel.field.of_force[0][d] + kappa * kernel.field.of_force[1][d]) *
          force.value(points.location[kernel.point], t);
    return 4. / (kappa + 1.) * sum;
  }



  double
  InteractionIntegral::of_uniform_body(const Vector        &stress,
                                       const ContactForces &contact_forces,
                                       const double         kappa) const
  {
    Assert(kappa_of_ring == 0. || std::abs(kappa - kappa_of_ring) <= 1e-8,
           ExcInternalError());
    double sum = 0.;
    for (const Kernel &kernel : kernels)
      {
        const VoigtVector<2> s = QuadratureField<2>::get(
          stress, kernel.point * QuadratureField<2>::n_components);
        sum += kernel.field.of_stress[0] * s +
               kappa * (kernel.field.of_stress[1] * s);
      }
    sum *= 4. / (kappa + 1.);
    const std::vector<double> &normal = contact_forces.normal;
    for (std::size_t i = 0; i < of_pressure_on_bends[0].size(); ++i)
      sum += 4. / (kappa + 1.) *
             (of_pressure_on_bends[0][i] + kappa * of_pressure_on_bends[1][i]) *
             normal[i];
    LipForces::Sums sums{};
    sums[LipForces::of_forces] = sums[LipForces::with_line] = sum;
    of_contact_forces.add(mode == CrackMode::opening ||
                              contact_forces.tangential.empty()
                            ? normal
                            : contact_forces.tangential[0],
                          normal,
                          sums);
    const ArrayView<double> all(sums.data(), sums.size());
    Utilities::MPI::sum(ArrayView<const double>(all),
                        body.space.communicator(),
                        all);
    return LipForces::chosen(sums);
  }



  Vector
  InteractionIntegral::factor_of_stress(const MaterialState<2> &material,
                                        const TipElasticity    &at_tip) const
  {
    Vector all;
    body.points.initialize(all);
    const double kappa  = at_tip.kappa();
    const bool   varies = !material.stiffness->is_uniform();
    for (const Kernel &kernel : kernels)
      {
        VoigtVector<2> N =
          4. / (kappa + 1.) *
          (kernel.field.of_stress[0] + kappa * kernel.field.of_stress[1]);
        if (varies)
          {
            const VoigtVector<2> &tau = kernel.field.of_strain;
            const PlaneCompliance law((*material.stiffness)[kernel.point],
                                      kappa_of_ring > 0.);
            N -= at_tip.modulus() *
                 (law.of_stress * tau -
                  (kappa_of_ring > 0. ? at_tip.isotropic.strain_with_hoops(tau)
                                      : at_tip.strain(tau, is_below(kernel))));
          }
        QuadratureField<2>::set(all,
                                kernel.point * QuadratureField<2>::n_components,
                                N / points.weight[kernel.point]);
      }
    return all;
  }



  double
  InteractionIntegral::value(const double            t,
                             const Sample           &sample,
                             const ContactForces    &contact_forces,
                             const MaterialState<2> &material,
                             const TipElasticity    &at_tip) const
  {
    const double of_uniform =
      of_uniform_body(sample.state.stress, contact_forces, at_tip.kappa());
    const bool creeps = has_creep && sample.viscous_strain.size() > 0;
    double     sum    = of_forces(t, at_tip.kappa());
    if (creeps || !material.stiffness->is_uniform() ||
        material.thermal_strain != nullptr)
      sum += of_variation(sample, material, at_tip, creeps);
    if (of_displacement.size() > 0)
      {
        // Without openings, which of_displacement has as further unknowns.
        const Vector nodal = body.nodal_displacement(sample.state.displacement,
                                                     sample.state.instant,
                                                     sample.time);
        double       of_lips = 0.;
        for (std::size_t i = 0; i < nodal.locally_owned_size(); ++i)
          of_lips += of_displacement.local_element(i) * nodal.local_element(i);
        sum -= material.stiffness_factor * at_tip.modulus() * of_lips;
      }
    return of_uniform - Utilities::MPI::sum(sum, body.space.communicator());
  }



  double
  InteractionIntegral::of_variation(const Sample           &sample,
                                    const MaterialState<2> &material,
                                    const TipElasticity    &at_tip,
                                    const bool              creeps) const
  {
    using Field                  = QuadratureField<2>;
    const auto        laws       = transform(*material.stiffness,
                                body.points.n_local_points,
                                [this](const VoigtMatrix<2> &K) {
                                  return PlaneCompliance(K, kappa_of_ring > 0.);
                                });
    const double      k          = material.stiffness_factor;
    const std::size_t n_branches = creeps ? material.fractions.size() : 0;

    double sum = 0.;
    for (const Kernel &kernel : kernels)
      {
        const std::size_t      offset = kernel.point * Field::n_components;
        const VoigtVector<2>   s      = Field::get(sample.state.stress, offset);
        const PlaneCompliance &law    = laws[kernel.point];
        const VoigtVector<2>   of_tip = kappa_of_ring > 0.
                                          ? at_tip.isotropic.strain_with_hoops(s)
                                          : at_tip.strain(s, is_below(kernel));
        VoigtVector<2>         strain = (law.of_stress * s - of_tip) / k;
        if (material.thermal_strain != nullptr)
          strain += law.free_strain((*material.thermal_strain)[kernel.point]);
        sum += kernel.field.of_strain * strain;
        for (unsigned int i = 0; i < n_branches; ++i)
          sum += material.fractions[i] *
                 (kernel.of_viscous_strain *
                  law.free_strain(
                    Field::get(sample.viscous_strain,
                               offset * n_branches + i * Field::n_components)));
      }
    return k * at_tip.modulus() * sum;
  }
} // namespace Crevasse
