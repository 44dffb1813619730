// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/discretisation/singular_shapes.h>

#include <deal.II/base/numbers.h>
#include <deal.II/base/quadrature_lib.h>
#include <deal.II/base/utilities.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe_values_extractors.h>
#include <deal.II/lac/affine_constraints.h>

#include <numeric>

namespace Crevasse
{
  using namespace dealii;

  Tensor<1, 2>
  SingularFunction::value(const Point<2> &point,
                          const Point<2> &cell_center) const
  {
    const Point<2> local = tip.local(point, cell_center);
    const double   rest  = 1. - local.norm_square() / (radius * radius);
    if (rest <= 0.)
      return {};
    return Utilities::fixed_power<3>(rest) *
           tip.global(field.displacement(local));
  }



  Tensor<2, 2>
  SingularFunction::gradient(const Point<2> &point,
                             const Point<2> &cell_center) const
  {
    const Point<2> local = tip.local(point, cell_center);
    const double   rest  = 1. - local.norm_square() / (radius * radius);
    if (rest <= 0.)
      return {};
    const Tensor<1, 2> of_factor =
      -6. * rest * rest / (radius * radius) * Tensor<1, 2>(local);
    const Tensor<2, 2> to_local = tip.to_local();
    return transpose(to_local) *
           (Utilities::fixed_power<3>(rest) * field.gradient(local) +
            outer_product(field.displacement(local), of_factor)) *
           to_local;
  }



  SingularFunctions
  make_singular_functions(const unsigned int     n,
                          const CrackTip        &tip,
                          const PlaneElasticity &elasticity,
                          const double           length,
                          const double           radius)
  {
    Assert(n >= 1 && n <= 3, ExcInternalError());
    const double kappa = elasticity.kappa();
    // K of w₁: 2μu = williams_term(1) has K = √(2π).
    const double intensity = 2. * elasticity.shear_modulus *
                             std::sqrt(2. * numbers::PI / length) /
                             (kappa + 1.);
    SingularFunctions functions;
    for (const CrackMode mode : {CrackMode::opening, CrackMode::sliding})
      {
        // The n-th term opens the lips by (κ + 1) r^{n/2}, up to its sign.
        const auto add = [&](PolarField field, const double power) {
          field *= std::pow(length, -power) / (kappa + 1.);
          functions.push_back({tip, mode, field, radius, 0.});
        };
        add(williams_term(1, kappa, mode), 0.5);
        functions.back().stress_intensity = intensity;
        if (n >= 2)
          add(square_root_without_jump(mode), 0.5);
        if (n >= 3)
          add(williams_term(3, kappa, mode), 1.5);
        if (!tip.two_lips)
          break;
      }
    return functions;
  }



  SingularShapes::SingularShapes(const SingularFunctions &functions,
                                 const Mapping<2>        &mapping,
                                 const DoFHandler<2>     &dof_handler,
                                 const Quadrature<1>     &face_rule)
    : functions(functions)
  {
    const IndexSet relevant =
      DoFTools::extract_locally_relevant_dofs(dof_handler);
    AffineConstraints<double> hanging_nodes(relevant);
    DoFTools::make_hanging_node_constraints(dof_handler, hanging_nodes);
    hanging_nodes.close();
    const IndexSet &owned = dof_handler.locally_owned_dofs();
    interpolated.reserve(size()); // copies lose ghost values
    for (unsigned int k = 0; k < size(); ++k)
      interpolated.emplace_back(owned,
                                relevant,
                                dof_handler.get_communicator());

    const FiniteElement<2>              &fe = dof_handler.get_fe();
    FEValues<2>                          nodes(mapping,
                      fe,
                      Quadrature<2>(fe.get_unit_support_points()),
                      update_quadrature_points);
    std::vector<types::global_dof_index> dofs(fe.n_dofs_per_cell());
    for (const auto &cell : dof_handler.active_cell_iterators())
      if (cell->is_locally_owned())
        {
          nodes.reinit(cell);
          cell->get_dof_indices(dofs);
          for (unsigned int i = 0; i < dofs.size(); ++i)
            for (unsigned int k = 0; k < size() && owned.is_element(dofs[i]);
                 ++k)
              interpolated[k](dofs[i]) = functions[k].value(
                nodes.quadrature_point(i),
                cell->center())[fe.system_to_component_index(i).first];
        }
    for (Vector &vector : interpolated)
      {
        hanging_nodes.distribute(vector);
        vector.update_ghost_values();
      }
    find_fluxes(mapping, dof_handler, face_rule);
  }



  std::optional<Quadrature<1>>
  SingularShapes::rule_from_tip(
    const Triangulation<2>::face_iterator &face) const
  {
    for (const SingularFunction &function : functions)
      for (const unsigned int v : face->vertex_indices())
        if (face->vertex(v).distance(function.tip.position) <
            1e-8 * face->diameter())
          {
            const QGauss<1>       gauss(8);
            std::vector<Point<1>> points;
            std::vector<double>   weights;
            for (unsigned int k = 0; k < gauss.size(); ++k)
              {
                const double s = gauss.point(k)[0];
                points.emplace_back(v == 0 ? s * s : 1. - s * s);
                weights.push_back(2. * s * gauss.weight(k));
              }
            return Quadrature<1>(points, weights);
          }
    return {};
  }



  void
  SingularShapes::find_fluxes(const Mapping<2>    &mapping,
                              const DoFHandler<2> &dof_handler,
                              const Quadrature<1> &face_rule)
  {
    fluxes.assign(size(),
                  std::vector<Tensor<2, 2>>(
                    dof_handler.get_triangulation().n_active_cells()));
    const UpdateFlags flags = update_values | update_quadrature_points |
                              update_JxW_values | update_normal_vectors;
    FEFaceValues<2> usual(mapping, dof_handler.get_fe(), face_rule, flags);
    std::vector<std::vector<Tensor<1, 2>>> on_face;
    const auto add = [&](const auto &cell, const auto f, auto &&face_values) {
      face_values.reinit(cell, f);
      values(face_values, on_face);
      for (unsigned int k = 0; k < size(); ++k)
        for (const unsigned int q : face_values.quadrature_point_indices())
          fluxes[k][cell->active_cell_index()] +=
            face_values.JxW(q) *
            outer_product(on_face[k][q], face_values.normal_vector(q));
    };
    for (const auto &cell : dof_handler.active_cell_iterators())
      for (const unsigned int f : cell->face_indices())
        if (!cell->is_locally_owned())
          break;
        else if (const auto rule = rule_from_tip(cell->face(f)))
          add(cell,
              f,
              FEFaceValues<2>(mapping, dof_handler.get_fe(), *rule, flags));
        else
          add(cell, f, usual);
  }



  void
  SingularShapes::values(const FEValuesBase<2>                  &values,
                         std::vector<std::vector<Tensor<1, 2>>> &result) const
  {
    const Point<2> center = values.get_cell()->center();
    result.resize(size());
    for (unsigned int k = 0; k < size(); ++k)
      {
        result[k].resize(values.n_quadrature_points);
        values[FEValuesExtractors::Vector(0)].get_function_values(
          interpolated[k], result[k]);
        for (const unsigned int q : values.quadrature_point_indices())
          result[k][q] =
            functions[k].value(values.quadrature_point(q), center) -
            result[k][q];
      }
  }



  void
  SingularShapes::gradients(
    const FEValues<2>                      &values,
    std::vector<std::vector<Tensor<2, 2>>> &result) const
  {
    const auto    &cell    = values.get_cell();
    const Point<2> center  = cell->center();
    const auto    &weights = values.get_JxW_values();
    const double   area = std::accumulate(weights.begin(), weights.end(), 0.);
    result.resize(size());
    for (unsigned int k = 0; k < size(); ++k)
      {
        result[k].resize(values.n_quadrature_points);
        values[FEValuesExtractors::Vector(0)].get_function_gradients(
          interpolated[k], result[k]);
        Tensor<2, 2> missing = fluxes[k][cell->active_cell_index()];
        for (const unsigned int q : values.quadrature_point_indices())
          {
            result[k][q] =
              functions[k].gradient(values.quadrature_point(q), center) -
              result[k][q];
            missing -= weights[q] * result[k][q];
          }
        for (Tensor<2, 2> &gradient : result[k])
          gradient += missing / area;
      }
  }
} // namespace Crevasse
