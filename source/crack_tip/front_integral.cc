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
    VoigtVector<3>
    sum_of_ranks(VoigtVector<3> value, const MPI_Comm communicator)
    {
      const ArrayView<double> values(value.begin_raw(), 6);
      Utilities::MPI::sum(ArrayView<const double>(values),
                          communicator,
                          values);
      return value;
    }
  } // namespace



  FrontIntegral::FrontIntegral(const Body<3>        &body,
                               const FrontRegion    &region,
                               const LoadParameters &loads,
                               const FrontFields    &fields)
    : fields(fields)
    , body(body)
    , region(region)
    , loads(loads)
    , body_force(components_in_volume(loads))
  {
    integrate_over_cells();
    balance(integrate_over_lips());
  }



  void
  FrontIntegral::integrate_over_cells()
  {
    // In parts, as hats of small elements have kinks within larger cells.
    KernelRules<3> rules(body.space,
                         QIterated<3>(QGauss<1>(3), 4),
                         Quadrature<3>(crowded_rule(18)));
    for (const auto &cell : owned_cells(body.space.mesh()))
      {
        if (!region.is_near(cell, fields.weight.radius))
          continue;
        const std::size_t first    = body.points.first_point(cell);
        const auto        n_points = body.space.quadrature(cell).size();
        const auto       &values = rules.reinit(cell, region.is_at_front(cell));
        std::map<unsigned int, std::vector<Kernel>> of_cell; // by vertex
        for (const unsigned int q : values.quadrature_point_indices())
          {
            const FrontFrame frame =
              region.curve.frame(values.quadrature_point(q));
            if (std::max(std::abs(frame.X), std::abs(frame.Y)) >=
                fields.weight.radius)
              continue;
            const auto [of_value, of_slope] = fields.at(frame);
            for (const auto &hat : region.hats(frame))
              {
                FrontField here;
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



  std::vector<VoigtVector<3>>
  FrontIntegral::integrate_over_lips()
  {
    const Space<3>   &space = body.space;
    const auto       &fe    = space.finite_element;
    const UpdateFlags flags = update_values | update_quadrature_points |
                              update_JxW_values | update_normal_vectors;
    FEFaceValues<3>                      usual(space.mapping,
                          fe,
                          QIterated<2>(QGauss<1>(3), 4),
                          flags);
    FEFaceValues<3>                      fine(space.mapping,
                         fe,
                         Quadrature<2>(crowded_rule(16)),
                         flags);
    std::vector<types::global_dof_index> dofs(fe.n_dofs_per_cell());
    const std::size_t                    n_vertices = region.vertices.size();
    LipSums lips{std::vector<VoigtVector<3>>(n_vertices),
                 decltype(LipSums::of_traction)(n_vertices)};
    for (const auto &cell : owned_cells(space.dof_handler))
      for (const unsigned int f : cell->face_indices())
        {
          if (!cell->at_boundary(f) ||
              !region.is_near(cell, fields.weight.radius) ||
              !space.roles.is_lip(cell->face(f)->boundary_id()))
            continue;
          FEFaceValues<3> &values = region.is_at_front(cell) ? fine : usual;
          values.reinit(cell, f);
          cell->get_dof_indices(dofs);
          for (const unsigned int q : values.quadrature_point_indices())
            add_lip_point(values, q, dofs, lips);
        }
    keep_contact_forces(lips);
    for (VoigtVector<3> &of_stress : lips.of_stress)
      of_stress = sum_of_ranks(of_stress, space.communicator());
    return lips.of_stress;
  }



  void
  FrontIntegral::balance(const std::vector<VoigtVector<3>> &lips)
  {
    // Spread corrections over the volume: stress is largest at the front.
    std::vector<double> volumes(body.points.n_local_points);
    for (const auto &cell : owned_cells(body.space.mesh()))
      if (region.is_near(cell, fields.weight.radius))
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
    struct Sum
    {
      VoigtVector<3> of_strain, of_stress;
      double         volume = 0.;
    };
    std::vector<Sum> sums(region.vertices.size());
    for (const Kernel &kernel : kernels)
      {
        Sum &sum = sums[kernel.vertex];
        sum.of_strain += kernel.of_strain;
        sum.of_stress += kernel.of_stress;
        sum.volume += volume(kernel);
      }
    for (unsigned int v = 0; v < sums.size(); ++v)
      {
        const MPI_Comm communicator = body.space.communicator();
        Sum           &sum          = sums[v];
        sum.of_strain               = sum_of_ranks(sum.of_strain, communicator);
        sum.of_stress               = sum_of_ranks(sum.of_stress, communicator);
        sum.volume    = Utilities::MPI::sum(sum.volume, communicator);
        sum.of_stress = what_lips_bear(v, sum.of_stress - lips[v]);
      }
    for (Kernel &kernel : kernels)
      {
        const Sum   &sum  = sums[kernel.vertex];
        const double part = volume(kernel) / sum.volume;
        kernel.of_strain -= part * sum.of_strain;
        kernel.of_stress -= part * sum.of_stress;
      }
  }



  VoigtVector<3>
  FrontIntegral::what_lips_bear(const unsigned int    v,
                                const VoigtVector<3> &of_stress) const
  {
    const FrontRegion::Vertex &vertex = region.vertices[v];
    const FrontFrame           frame  = region.curve.frame(vertex.point);
    SymmetricTensor<2, 3>      local;
    for (unsigned int i = 0; i < 3; ++i)
      for (unsigned int j = i; j < 3; ++j)
        {
          // Shears do work on the plane of symmetry ahead of one lip, and on
          // the boundary where the front ends.
          const bool on_plane = !fields.two_lips && (i == 1) != (j == 1);
          const bool at_end   = vertex.is_end() && (i == 2) != (j == 2);
          if (on_plane || at_end)
            continue;
          SymmetricTensor<2, 3> unit;
          unit[i][j] = 1.;
          local[i][j] =
            (i == j ? 1. : 0.5) * (of_stress * to_mesh(frame, unit, 1.));
        }
    return to_mesh(frame, local, 2.);
  }



  std::vector<double>
  FrontIntegral::values(const double            t,
                        const Sample           &sample,
                        const MaterialState<3> &material) const
  {
    std::vector<double> K = sums_of(sample.state.stress);
    if (material.thermal_strain != nullptr)
      for (const Kernel &kernel : kernels)
        K[kernel.vertex] -=
          material.stiffness_factor *
          (kernel.of_strain * (*material.thermal_strain)[kernel.point]);
    for (const auto &[d, force] : body_force)
      for (const Kernel &kernel : kernels)
        K[kernel.vertex] -=
          kernel.of_force[d] * force.value(kernel.location, t);
    for (const LoadedPoint &place : loaded)
      K[place.vertex] -=
        place.of_force *
        surface_force<3>(loads, place.id, place.point, place.normal, t);
    return at_vertices(K, sample.state.contact_forces);
  }



  std::vector<double>
  FrontIntegral::sums_of(const Vector &stress) const
  {
    std::vector<double> K(region.vertices.size());
    for (const Kernel &kernel : kernels)
      K[kernel.vertex] +=
        kernel.of_stress *
        QuadratureField<3>::get(stress,
                                kernel.point *
                                  QuadratureField<3>::n_components);
    return K;
  }



  std::vector<double>
  FrontIntegral::at_vertices(std::vector<double>  K,
                             const ContactForces &forces) const
  {
    const auto                  &vertices = region.vertices;
    std::vector<LipForces::Sums> sums(K.size());
    for (std::size_t v = 0; v < K.size(); ++v)
      sums[v][LipForces::of_forces] = sums[v][LipForces::with_line] = K[v];
    for (const auto &[vertex, component, of_forces] : of_contact_forces)
      of_forces.add(component == 0 ? forces.normal
                                   : forces.tangential[component - 1],
                    forces.normal,
                    sums[vertex]);
    const ArrayView<double> all(sums[0].data(), sums.size() * sums[0].size());
    Utilities::MPI::sum(ArrayView<const double>(all),
                        body.space.communicator(),
                        all);
    for (std::size_t v = 0; v < K.size(); ++v)
      K[v] = LipForces::chosen(sums[v]) / vertices[v].integral();
    if (fields.mode == CrackMode::tearing)
      for (std::size_t v = 0; v < K.size(); ++v)
        if (const auto &end = vertices[v]; end.is_end())
          {
            const int         step = end.before == 0. ? 1 : -1;
            const std::size_t i = v + step, j = i + step;
            K[v] = end.on_symmetry ? 0. : K[i];
            if (!end.on_symmetry && !vertices[j].is_end())
              K[v] += (K[i] - K[j]) * (end.s - vertices[i].s) /
                      (vertices[i].s - vertices[j].s);
          }
    std::vector<double> values = region.values_of_means(K);
    for (std::size_t v = 0; v < K.size(); ++v)
      if (fields.mode == CrackMode::tearing && vertices[v].is_end())
        values[v] = K[v];
    return values;
  }
} // namespace Crevasse
