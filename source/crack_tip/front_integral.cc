// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/crack_tip/front_integral.h>
#include <crevasse/crack_tip/kernel_rules.h>

#include <map>

namespace Crevasse
{
  using namespace dealii;

  namespace
  {
    /** Gauss points that crowd at both ends, x = u³(10 − 15u + 6u²): in cells
     * at the front for products with r^(−3/2) at any edge, on the lip with
     * r^(−1/2). */
    Quadrature<1>
    crowded_rule(const unsigned int n)
    {
      const QGauss<1>       gauss(n);
      std::vector<Point<1>> points;
      std::vector<double>   weights;
      for (unsigned int k = 0; k < n; ++k)
        {
          const double u = gauss.point(k)[0], v = 1. - u;
          points.emplace_back(u * u * u * (10. - 15. * u + 6. * u * u));
          weights.push_back(gauss.weight(k) * 30. * u * u * v * v);
        }
      return Quadrature<1>(points, weights);
    }



    /** A symmetric tensor with components along ahead, inward and tangent as a
     * vector in the coordinates of the mesh. */
    VoigtVector<3>
    to_mesh(const FrontFrame            &frame,
            const SymmetricTensor<2, 3> &local,
            const double                 of_shear)
    {
      Tensor<2, 3> turn;
      turn[0]                   = frame.ahead;
      turn[1]                   = frame.inward;
      turn[2]                   = frame.tangent;
      const Tensor<2, 3> tensor = transpose(turn) * Tensor<2, 3>(local) * turn;
      VoigtVector<3>     vector;
      for (unsigned int i = 0; i < 3; ++i)
        for (unsigned int j = i; j < 3; ++j)
          vector[voigt_index<3>(i, j)] =
            (i == j ? 1. : of_shear) * tensor[i][j];
      return vector;
    }
  } // namespace



  FrontIntegral::FrontIntegral(const Body<3>         &body,
                               const FrontRegion     &region,
                               const LoadParameters  &loads,
                               const FrontElasticity &elasticity,
                               const double           size)
    : body(body)
    , region(region)
    , elasticity(elasticity)
    , weight{size, 3}
    , body_force(components_in_volume(loads))
  {
    integrate_over_cells();
    balance(integrate_over_lip());
  }



  std::pair<FrontIntegral::Field, FrontIntegral::Field>
  FrontIntegral::fields(const FrontFrame &frame) const
  {
    const auto f = weight.factor(frame.X), g = weight.factor(frame.Y);
    if (f[0] == 0. || g[0] == 0.)
      return {};
    const BuecknerField B(Point<2>(frame.X, frame.Y));
    const double        nu = elasticity.poisson_ratio, kappa = 3. - 4. * nu;
    const std::complex<double> u = // E' u^B
      4. / (kappa + 1.) * (kappa * B.Phi - B.rest);
    const double phi = B.airy, phi_X = B.along.real(), phi_Y = B.along.imag();
    const double Q = f[0] * g[0], Q_X = f[1] * g[0], Q_Y = f[0] * g[1];
    const double metric = frame.metric(), k = frame.curvature / metric;

    SymmetricTensor<2, 3> rest; // τ − Q σ^B
    rest[0][0] = 2. * Q_Y * phi_Y + f[0] * g[2] * phi;
    rest[1][1] =
      2. * Q_X * phi_X + f[2] * g[0] * phi + 2. * k * (Q_X * phi + Q * phi_X);
    rest[0][1] = -Q_X * phi_Y - Q_Y * phi_X - f[1] * g[1] * phi -
                 k * (Q_Y * phi + Q * phi_Y);
    SymmetricTensor<2, 3> strain; // E' (ε(w) − Q ε^B)
    strain[0][0]          = Q_X * u.real();
    strain[1][1]          = Q_Y * u.imag();
    strain[0][1]          = 0.5 * (Q_X * u.imag() + Q_Y * u.real());
    strain[2][2]          = k * Q * u.real();
    const auto compliance = [nu](const SymmetricTensor<2, 3> &s) { // E' S s
      return ((1. + nu) * s -
              nu * trace(s) * unit_symmetric_tensor<3, double>()) /
             (1. - nu * nu);
    };
    // ε^B is S times σ^B with the component ν (σ₁₁ + σ₂₂) along the front,
    // which τ has not.
    SymmetricTensor<2, 3> along_front;
    along_front[2][2] = Q * nu * 2. * B.mean;

    SymmetricTensor<2, 3> tau = rest;
    tau[0][0] += Q * (B.mean - B.half_difference.real());
    tau[1][1] += Q * (B.mean + B.half_difference.real());
    tau[0][1] += Q * B.half_difference.imag();

    SymmetricTensor<2, 3> of_slope;
    of_slope[0][2]       = 0.5 * Q / metric * u.real();
    of_slope[1][2]       = 0.5 * Q / metric * u.imag();
    const Field of_value = {
      to_mesh(frame, strain - compliance(rest - along_front), 2.),
      elasticity.modulus() * to_mesh(frame, tau, 1.),
      Q * (u.real() * frame.ahead + u.imag() * frame.inward)};
    return {of_value, {to_mesh(frame, of_slope, 2.), {}, {}}};
  }



  void
  FrontIntegral::integrate_over_cells()
  {
    KernelRules<3> rules(body.space,
                         QGauss<3>(10),
                         Quadrature<3>(crowded_rule(18)));
    for (const auto &cell : owned_cells(body.space.mesh()))
      {
        if (!region.is_near(cell, weight.radius))
          continue;
        const std::size_t first    = body.points.first_point(cell);
        const auto        n_points = body.space.quadrature(cell).size();
        const auto       &values = rules.reinit(cell, region.is_at_front(cell));
        std::map<unsigned int, std::vector<Kernel>> of_cell; // by vertex
        for (const unsigned int q : values.quadrature_point_indices())
          {
            const FrontFrame frame =
              region.curve.frame(values.quadrature_point(q));
            if (std::max(std::abs(frame.X), frame.Y) >= weight.radius)
              continue;
            const auto [of_value, of_slope] = fields(frame);
            for (const auto &hat : region.hats(frame))
              {
                Field here;
                here.add(hat.value * values.JxW(q), of_value);
                here.add(hat.slope * values.JxW(q), of_slope);
                auto &of_vertex = of_cell[hat.vertex];
                of_vertex.resize(n_points);
                for (unsigned int p = 0; p < n_points; ++p)
                  of_vertex[p].add(values.shape_value(p, q), here);
              }
          }
        FEValues<3> places(body.space.mapping,
                           body.space.finite_element,
                           body.space.quadrature(cell),
                           update_quadrature_points);
        places.reinit(cell);
        for (auto &[vertex, of_vertex] : of_cell)
          for (unsigned int p = 0; p < n_points; ++p)
            {
              of_vertex[p].vertex   = vertex;
              of_vertex[p].point    = first + p;
              of_vertex[p].location = places.quadrature_point(p);
              kernels.push_back(of_vertex[p]);
            }
      }
  }



  std::vector<double>
  FrontIntegral::integrate_over_lip()
  {
    const Space<3>   &space = body.space;
    const auto       &fe    = space.finite_element;
    const UpdateFlags flags =
      update_values | update_quadrature_points | update_JxW_values;
    FEFaceValues<3>     usual(space.mapping, fe, QGauss<2>(10), flags);
    FEFaceValues<3>     fine(space.mapping,
                         fe,
                         Quadrature<2>(crowded_rule(16)),
                         flags);
    std::vector<double> of_lip(region.vertices.size());
    std::vector<types::global_dof_index> dofs(fe.n_dofs_per_cell());
    std::vector<std::map<types::global_dof_index, double>> per_pressure(
      region.vertices.size());
    for (const auto &cell : owned_cells(space.dof_handler))
      for (const unsigned int f : cell->face_indices())
        {
          if (!cell->at_boundary(f) || !region.is_near(cell, weight.radius) ||
              space.roles.contact.count(cell->face(f)->boundary_id()) == 0)
            continue;
          FEFaceValues<3> &values = region.is_at_front(cell) ? fine : usual;
          values.reinit(cell, f);
          cell->get_dof_indices(dofs);
          for (const unsigned int q : values.quadrature_point_indices())
            {
              const FrontFrame frame =
                region.curve.frame(values.quadrature_point(q));
              if (frame.X >= 0. || frame.Y > 1e-8 * cell->diameter())
                continue;
              const double factor = 2. /
                                    std::sqrt(-2. * numbers::PI * frame.X) *
                                    weight.factor(frame.X)[0] * values.JxW(q);
              for (const unsigned int i : values.dof_indices())
                if (const unsigned int d =
                      fe.system_to_component_index(i).first;
                    fe.has_support_on_face(i, f) &&
                    std::abs(frame.inward[d]) > 0.5)
                  for (const auto &hat : region.hats(frame))
                    {
                      const double part =
                        factor * hat.value * values.shape_value(i, q);
                      per_pressure[hat.vertex][dofs[i]] += part;
                      of_lip[hat.vertex] += part;
                    }
            }
        }
    Vector sums = space.ghosted_vector();
    for (unsigned int v = 0; v < per_pressure.size(); ++v)
      {
        sums = 0.;
        for (const auto &[dof, value] : per_pressure[v])
          sums(dof) += value;
        const std::vector<double> factors = body.lip.of_contact_forces(sums);
        for (std::size_t i = 0; i < factors.size(); ++i)
          if (factors[i] != 0.)
            of_contact_forces.emplace_back(v, i, factors[i]);
      }
    Utilities::MPI::sum(of_lip, space.communicator(), of_lip);
    return of_lip;
  }



  void
  FrontIntegral::balance(const std::vector<double> &lip)
  {
    // Spread over the volume: stress is largest at the front.
    std::vector<double> volumes(body.points.n_local_points);
    for (const auto &cell : owned_cells(body.space.mesh()))
      if (region.is_near(cell, weight.radius))
        {
          FEValues<3> values(body.space.mapping,
                             body.space.finite_element,
                             body.space.quadrature(cell),
                             update_JxW_values);
          values.reinit(cell);
          for (const unsigned int q : values.quadrature_point_indices())
            volumes[body.points.first_point(cell) + q] = values.JxW(q);
        }
    const auto volume = [&](const Kernel &kernel) {
      double sum = 0.;
      for (const auto &hat : region.hats(region.curve.frame(kernel.location)))
        sum += hat.vertex == kernel.vertex ? hat.value : 0.;
      return sum * volumes[kernel.point];
    };
    // Of a vertex: strain, stress, volume.
    constexpr unsigned int n = 13;
    std::vector<double>    sums(n * region.vertices.size());
    for (const Kernel &kernel : kernels)
      {
        double *sum = &sums[n * kernel.vertex];
        for (unsigned int c = 0; c < 6; ++c)
          {
            sum[c] += kernel.of_strain[c];
            sum[6 + c] += kernel.of_stress[c];
          }
        sum[12] += volume(kernel);
      }
    Utilities::MPI::sum(sums, body.space.communicator(), sums);
    for (Kernel &kernel : kernels)
      {
        const double *sum    = &sums[n * kernel.vertex];
        const double  part   = volume(kernel) / sum[12];
        const auto   &vertex = region.vertices[kernel.vertex];
        const auto    frame  = region.curve.frame(vertex.point);
        const auto   &inward = frame.inward;
        // A shear along the plane at an end of the front does work there.
        const bool is_end     = vertex.before == 0. || vertex.after == 0.;
        const bool is_oblique = is_end && std::abs(frame.tangent[0]) +
                                              std::abs(frame.tangent[1]) +
                                              std::abs(frame.tangent[2]) >
                                            1. + 1e-6;
        kernel.of_strain -=
          part * VoigtVector<3>(make_array_view(sum, sum + 6));
        for (unsigned int i = 0; i < 3; ++i)
          for (unsigned int j = i; j < 3; ++j)
            {
              const unsigned int c        = voigt_index<3>(i, j);
              const double       i_normal = std::abs(inward[i]);
              const double       j_normal = std::abs(inward[j]);
              if (i_normal + j_normal < 0.5 && !is_oblique &&
                  (i == j || !is_end)) // leaves the crack plane free
                kernel.of_stress[c] -= part * sum[6 + c];
              else if (i == j && i_normal > 0.5) // the lip bears it
                kernel.of_stress[c] -= part * (sum[6 + c] - lip[kernel.vertex]);
            }
      }
  }



  std::vector<double>
  FrontIntegral::values(const double            t,
                        const Sample           &sample,
                        const MaterialState<3> &material) const
  {
    std::vector<double> K(region.vertices.size());
    for (const Kernel &kernel : kernels)
      {
        double &sum = K[kernel.vertex];
        sum += kernel.of_stress *
               QuadratureField<3>::get(sample.state.stress,
                                       kernel.point *
                                         QuadratureField<3>::n_components);
        if (material.thermal_strain != nullptr)
          sum -= material.stiffness_factor *
                 (kernel.of_strain * (*material.thermal_strain)[kernel.point]);
        for (const auto &[d, force] : body_force)
          sum -= kernel.of_force[d] * force.value(kernel.location, t);
      }
    for (const auto &[vertex, node, factor] : of_contact_forces)
      K[vertex] += factor * sample.state.contact_forces[node];
    Utilities::MPI::sum(K, body.space.communicator(), K);
    for (std::size_t v = 0; v < K.size(); ++v)
      K[v] /= region.vertices[v].integral();
    return K;
  }
} // namespace Crevasse
