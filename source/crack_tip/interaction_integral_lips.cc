// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/crack_tip/interaction_integral.h>

#include <set>

namespace Crevasse
{
  using namespace dealii;

  namespace
  {
    Tensor<1, 2>
    traction(const VoigtVector<2> &stress, const Tensor<1, 2> &n)
    {
      return Tensor<1, 2>({stress[0] * n[0] + stress[3] * n[1],
                           stress[3] * n[0] + stress[1] * n[1]});
    }



    /** Symmetric part of x ⊗ t. */
    VoigtVector<2>
    moment(const Tensor<1, 2> &x, const Tensor<1, 2> &t)
    {
      VoigtVector<2> vector;
      vector[0] = x[0] * t[0];
      vector[1] = x[1] * t[1];
      vector[3] = 0.5 * (x[0] * t[1] + x[1] * t[0]);
      return vector;
    }
  } // namespace



  std::array<VoigtVector<2>, 2>
  InteractionIntegral::integrate_over_lips(const double size)
  {
    const SquareWeight            weight = region.weight(size);
    std::array<VoigtVector<2>, 2> lips;
    for (const LipPoint &point : lip_points(body.space, region, size))
      {
        AuxiliaryField field;
        field.add(factor(point), field_at(point.local, weight));
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
        if (region.has_bends())
          of_uniform_strain += moment(point.point - region.tip.position,
                                      traction(field.of_strain, point.normal));
      }
    // A uniform stress has a displacement of the lips, too.
    if (kappa_of_ring > 0.)
      {
        lips[0] -= strain_on_rings(of_uniform_strain);
        return lips;
      }
    VoigtVector<2> twofold = of_uniform_strain, both;
    twofold[3] *= 2.;
    both[0] = both[1] = of_uniform_strain[0] + of_uniform_strain[1];
    lips[0] -= anisotropic != nullptr ? anisotropic->modulus() *
                                          anisotropic->strain(of_uniform_strain)
                                      : twofold - 0.75 * both;
    if (anisotropic == nullptr)
      lips[1] -= 0.25 * both;
    return lips;
  }



  void
  InteractionIntegral::integrate_displacement(const double size)
  {
    const SquareWeight weight = region.weight(size);
    Tensor<1, 2>       total;
    of_displacement =
      lip_work(body.space, region, size, [&](const LipPoint &point) {
        const Tensor<1, 2> force =
          factor(point) *
          traction(field_at(point.local, weight).of_strain, point.normal);
        total += force;
        return force;
      });
    of_displacement.compress(VectorOperation::add);
    // Displacements count from that of the tip: translations contribute
    // nothing, though the nodes of both lips differ by rounding, at which T's
    // field is large.
    for (const unsigned int d : {0, 1})
      total[d] = Utilities::MPI::sum(total[d], body.space.communicator());
    std::set<types::global_dof_index> of_tip;
    for (const auto &cell : owned_cells(body.space.dof_handler))
      for (const unsigned int v : cell->vertex_indices())
        if (cell->vertex(v).distance(region.tip.position) <
            1e-6 * region.cell_radius)
          for (const unsigned int d : {0, 1})
            if (const auto dof = cell->vertex_dof_index(v, d);
                of_displacement.in_local_range(dof) &&
                of_tip.insert(dof).second)
              of_displacement(dof) -= total[d];
  }



  void
  InteractionIntegral::integrate_over_bends(const double size)
  {
    const SquareWeight weight = region.weight(size);
    if (region.has_bends() || is_closed)
      integrate_displacement(size);
    // A pressure of contact acts along the normal.
    for (const unsigned int k : {0, 1})
      {
        Vector per_pressure =
          lip_work(body.space, region, size, [&](const LipPoint &point) {
            const double along =
              factor(point) *
              (field_at(point.local, weight).of_force[k] * point.normal);
            return Tensor<1, 2>({along, along});
          });
        of_pressure_on_bends[k] = body.lip.of_contact_forces(per_pressure);
      }
  }



  VoigtVector<2>
  InteractionIntegral::what_lips_bear(const VoigtVector<2> &of_stress) const
  {
    // Uniform stress has a T, and does not exist in two bodies.
    if (mode == CrackMode::constant || interface != nullptr)
      return {};
    VoigtVector<2> factors = of_stress;
    if (kappa_of_ring > 0.)
      {
        // Neither a radial stress alone nor a shear is in equilibrium on rings.
        factors[0] = factors[2] = 0.5 * (factors[0] + factors[2]);
        factors[3]              = 0.;
      }
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



  VoigtVector<2>
  InteractionIntegral::strain_factor_above(const double size) const
  {
    // τ is in equilibrium: only the interface bears it, as r^(−3/2).
    const SquareWeight weight = region.weight(size);
    const QGauss<1>    rule(64);
    VoigtVector<2>     sum;
    for (unsigned int q = 0; q < rule.size(); ++q)
      {
        const double   root = rule.point(q)[0], r = root * root * size;
        const Point<2> local(r, 0.);
        sum += rule.weight(q) * 2. * root * size *
               moment(r * region.tip.ahead,
                      traction(field_at(local, weight).of_strain,
                               -region.tip.inward));
      }
    return sum;
  }



  void
  InteractionIntegral::balance(const std::array<VoigtVector<2>, 2> &lips,
                               const double                         size)
  {
    const MPI_Comm                communicator = body.space.communicator();
    std::array<VoigtVector<2>, 2> sum, of_stress; // sum: above and below
    std::array<double, 2>         n_at_tip{};
    double                        area = 0.;
    for (const Kernel &kernel : kernels)
      {
        area += points.weight[kernel.point];
        sum[is_below(kernel)] += kernel.field.of_strain;
        for (const unsigned int k : {0, 1})
          of_stress[k] += kernel.field.of_stress[k];
        n_at_tip[is_below(kernel)] += kernel.of_limit;
      }
    const auto of_ranks = [communicator](VoigtVector<2> vector) {
      for (unsigned int c = 0; c < QuadratureField<2>::n_components; ++c)
        vector[c] = Utilities::MPI::sum(vector[c], communicator);
      return vector;
    };
    sum[0] = of_ranks(sum[0] - of_uniform_strain);
    if (interface != nullptr)
      {
        const VoigtVector<2> above = strain_factor_above(size);
        sum[0] -= above;
        sum[1] = of_ranks(sum[1]) + above;
      }
    for (const unsigned int k : {0, 1})
      of_stress[k] = what_lips_bear(of_ranks(of_stress[k] - lips[k]));
    VoigtVector<2> hoops;
    hoops[2] = Utilities::MPI::sum(of_hoops, communicator);
    if (kappa_of_ring > 0.)
      hoops = strain_on_rings(hoops);
    area = Utilities::MPI::sum(area, communicator);
    for (double &of_side : n_at_tip)
      of_side = Utilities::MPI::sum(of_side, communicator);
    for (Kernel &kernel : kernels)
      {
        const bool   side  = is_below(kernel);
        const double limit = kernel.of_limit / n_at_tip[side];
        kernel.field.of_strain -= limit * sum[side];
        kernel.field.of_stress[0] -= limit * hoops;
        // Spread over the square: stress is largest at the tip.
        for (const unsigned int k : {0, 1})
          kernel.field.of_stress[k] -=
            points.weight[kernel.point] / area * of_stress[k];
      }
  }
} // namespace Crevasse
