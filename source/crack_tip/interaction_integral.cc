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



    /** Frame of a circular front about the axis of revolution. */
    FrontFrame
    frame_at(const CrackTip &tip, const Point<2> &local)
    {
      FrontFrame frame;
      frame.X = local[0];
      frame.Y = local[1];
      for (const unsigned int d : {0, 1})
        {
          frame.ahead[d]  = tip.ahead[d];
          frame.inward[d] = tip.inward[d];
        }
      frame.tangent   = cross_product_3d(frame.ahead, frame.inward);
      frame.curvature = tip.ahead[0] / tip.position[0];
      return frame;
    }



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
    , loads(loads)
    , body_force(components_in_volume(loads))
    , of_contact_forces(
        mode == CrackMode::opening ||
            (mode == CrackMode::sliding && body.friction)
          ? lip_integral(body, region.tip, region.weight(squares.size))
          : std::vector<double>())
  {
    if (kappa_of_ring > 0.)
      for (double &factor : of_contact_forces)
        factor /= region.tip.position[0];
    integrate_over_cells(squares);
    balance(integrate_over_lips(squares.size));
  }



  AuxiliaryField
  InteractionIntegral::field_at(const Point<2>     &local,
                                const SquareWeight &weight) const
  {
    if (anisotropic != nullptr)
      return anisotropic->auxiliary(region.tip, mode, local, weight);
    if (kappa_of_ring == 0.)
      return AuxiliaryField(region.tip, mode, local, weight);
    const double      nu = (3. - kappa_of_ring) / 4.;
    const FrontFields fields{mode, false, {1., nu}, weight};
    const FrontField  of_front = fields.at(frame_at(region.tip, local)).first;
    const double      share    = 1. / region.tip.position[0];
    const double      of_kappa = (kappa_of_ring + 1.) / 4. * share;
    AuxiliaryField    field;
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



  void
  InteractionIntegral::integrate_over_cells(const Squares &squares)
  {
    const std::vector<std::pair<SquareWeight, double>> of_creep =
      weights_of_creep(region, squares);
    has_creep                = !of_creep.empty();
    const SquareWeight whole = region.weight(squares.size);
    const auto         add   = [&](Kernel         &kernel,
                         const Point<2> &point,
                         const double    share) {
      const auto field_of = [&](const SquareWeight &weight) {
        return field_at(region.tip.local(point), weight);
      };
      kernel.field.add(share, field_of(whole));
      for (const auto &[weight, factor] : of_creep)
        kernel.of_viscous_strain += share * factor * field_of(weight).of_strain;
    };
    const Space<2> &space = body.space;
    using Rules           = KernelRules<2>;
    Rules rules(space,
                QGauss<2>(Rules::points_per_direction(space) + 4),
                QIterated<2>(QGauss<1>(4), 8));
    for (const auto &cell : owned_cells(space.mesh()))
      {
        const auto &reach = region.reach(cell->active_cell_index());
        if (reach.first >= squares.size)
          continue;
        const std::size_t   first = body.points.first_point(cell);
        std::vector<Kernel> of_cell(space.quadrature(cell).size());
        for (unsigned int p = 0; p < of_cell.size(); ++p)
          of_cell[p].point = first + p;
        if (space.rule(cell) != 0)
          for (Kernel &kernel : of_cell)
            add(kernel,
                points.location[kernel.point],
                points.weight[kernel.point]);
        else
          {
            const FEValues<2> &values = rules.reinit(cell, reach.first == 0.);
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



  std::array<VoigtVector<2>, 2>
  InteractionIntegral::integrate_over_lips(const double size)
  {
    const SquareWeight            weight = region.weight(size);
    std::array<VoigtVector<2>, 2> lips;
    for (const LipPoint &point : lip_points(body.space, region.tip, size))
      {
        AuxiliaryField field;
        field.add(point.weight, field_at(point.local, weight));
        for (const unsigned int k : {0, 1})
          {
            const Tensor<2, 2> work =
              outer_product(field.of_force[k], point.normal);
            lips[k][0] += work[0][0];
            lips[k][1] += work[1][1];
            lips[k][3] += work[0][1] + work[1][0];
          }
        if (body.space.roles.loaded.count(point.id) > 0)
          loaded.emplace_back(point, field);
      }
    return lips;
  }



  VoigtVector<2>
  InteractionIntegral::what_lips_bear(const VoigtVector<2> &of_stress) const
  {
    if (mode == CrackMode::constant)
      return {}; // uniform stress has a T
    VoigtVector<2> factors = of_stress;
    if (kappa_of_ring > 0.)
      factors[0] = factors[2] = 0.5 * (factors[0] + factors[2]);
    if (region.tip.two_lips)
      return factors;
    // Ahead of one lip the plane of symmetry bears shear stress.
    VoigtVector<2> normal;
    normal[2] = factors[2];
    for (const Tensor<1, 2> &n : {region.tip.ahead, region.tip.inward})
      {
        const double of_n = factors[0] * n[0] * n[0] +
                            factors[1] * n[1] * n[1] + factors[3] * n[0] * n[1];
        normal[0] += of_n * n[0] * n[0];
        normal[1] += of_n * n[1] * n[1];
        normal[3] += of_n * 2. * n[0] * n[1];
      }
    return normal;
  }



  void
  InteractionIntegral::balance(const std::array<VoigtVector<2>, 2> &lips)
  {
    const MPI_Comm communicator = body.space.communicator();
    const auto     is_at_tip    = [&](const Kernel &kernel) {
      return region.reach(points.cell[kernel.point]).first == 0.;
    };
    VoigtVector<2>                sum;
    std::array<VoigtVector<2>, 2> of_stress;
    double                        area = 0., area_at_tip = 0.;
    for (const Kernel &kernel : kernels)
      {
        area += points.weight[kernel.point];
        sum += kernel.field.of_strain;
        for (const unsigned int k : {0, 1})
          of_stress[k] += kernel.field.of_stress[k];
        if (is_at_tip(kernel))
          area_at_tip += points.weight[kernel.point];
      }
    const auto of_ranks = [communicator](VoigtVector<2> vector) {
      for (unsigned int c = 0; c < QuadratureField<2>::n_components; ++c)
        vector[c] = Utilities::MPI::sum(vector[c], communicator);
      return vector;
    };
    sum = of_ranks(sum);
    for (const unsigned int k : {0, 1})
      of_stress[k] = what_lips_bear(of_ranks(of_stress[k] - lips[k]));
    area        = Utilities::MPI::sum(area, communicator);
    area_at_tip = Utilities::MPI::sum(area_at_tip, communicator);
    if (kappa_of_ring > 0.)
      {
        // On rings u₁ = x₁ strains hoops as well, and u₁ = x₂ is not uniform.
        sum[0] = sum[2] = 0.5 * (sum[0] + sum[2]);
        sum[3]          = 0.;
      }
    for (Kernel &kernel : kernels)
      {
        const double weight = points.weight[kernel.point];
        if (is_at_tip(kernel))
          kernel.field.of_strain -= weight / area_at_tip * sum;
        // Spread over the square: stress is largest at the tip.
        for (const unsigned int k : {0, 1})
          kernel.field.of_stress[k] -= weight / area * of_stress[k];
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
    if (of_contact_forces.empty())
      return Utilities::MPI::sum(sum, body.space.communicator());
    const std::vector<double> &on_lips = mode == CrackMode::opening
                                           ? contact_forces.normal
                                           : contact_forces.tangential.front();
    for (std::size_t i = 0; i < of_contact_forces.size(); ++i)
      sum += of_contact_forces[i] * on_lips[i];
    return Utilities::MPI::sum(sum, body.space.communicator());
  }



  double
  InteractionIntegral::value(const double            t,
                             const Sample           &sample,
                             const MaterialState<2> &material,
                             const TipElasticity    &at_tip) const
  {
    const double of_uniform = of_uniform_body(sample.state.stress,
                                              sample.state.contact_forces,
                                              at_tip.kappa());
    const bool   creeps     = has_creep && sample.viscous_strain.size() > 0;
    double       sum        = of_forces(t, at_tip.kappa());
    if (creeps || !material.stiffness->is_uniform() ||
        material.thermal_strain != nullptr)
      sum += of_variation(sample, material, at_tip, creeps);
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
                                          : at_tip.strain(s);
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
