// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/discretisation/singular_shapes.h>

#include <deal.II/base/function.h>
#include <deal.II/base/numbers.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe_values_extractors.h>
#include <deal.II/lac/affine_constraints.h>
#include <deal.II/numerics/vector_tools.h>


namespace Crevasse
{
  using namespace dealii;

  SingularFunctions
  make_singular_functions(const unsigned int     n,
                          const CrackTip        &tip,
                          const PlaneElasticity &elasticity,
                          const double           length)
  {
    Assert(n >= 1 && n <= 3, ExcInternalError());
    SingularFunctions functions{tip, {}, 0.};
    const double      kappa = elasticity.kappa();
    // The n-th term opens the lip by (κ + 1) r^{n/2}, up to its sign.
    const auto scaled = [&](PolarField field, const double power) {
      return field *= std::pow(length, -power) / (kappa + 1.);
    };
    functions.fields.push_back(scaled(williams_term(1, kappa), 0.5));
    if (n >= 2)
      functions.fields.push_back(scaled(square_root_without_opening(), 0.5));
    if (n >= 3)
      functions.fields.push_back(scaled(williams_term(3, kappa), 1.5));

    // 2μu = williams_term(1) has √(2π).
    functions.unit_stress_intensity = 2. * elasticity.shear_modulus *
                                      std::sqrt(2. * numbers::PI / length) /
                                      (kappa + 1.);
    return functions;
  }



  SingularShapes::SingularShapes(const SingularFunctions &functions,
                                 const Mapping<2>        &mapping,
                                 const DoFHandler<2>     &dof_handler)
    : functions(functions)
  {
    IndexSet relevant;
    DoFTools::extract_locally_relevant_dofs(dof_handler, relevant);
    AffineConstraints<double> hanging_nodes(relevant);
    DoFTools::make_hanging_node_constraints(dof_handler, hanging_nodes);
    hanging_nodes.close();
    interpolated.reserve(functions.fields.size()); // copies lose ghost values
    for (unsigned int k = 0; k < functions.fields.size(); ++k)
      {
        interpolated.emplace_back(dof_handler.locally_owned_dofs(),
                                  relevant,
                                  dof_handler.get_communicator());
        std::vector<std::function<double(const Point<2> &)>> components;
        for (unsigned int c = 0; c < 2; ++c)
          components.push_back([k, c, &functions](const Point<2> &point) {
            return functions.value(k, point)[c];
          });
        VectorTools::interpolate(mapping,
                                 dof_handler,
                                 FunctionFromFunctionObjects<2>(components),
                                 interpolated.back());
        hanging_nodes.distribute(interpolated.back());
        interpolated.back().update_ghost_values();
      }
  }



  void
  SingularShapes::values(const unsigned int         k,
                         const FEValuesBase<2>     &values,
                         std::vector<Tensor<1, 2>> &result) const
  {
    result.resize(values.n_quadrature_points);
    values[FEValuesExtractors::Vector(0)].get_function_values(interpolated[k],
                                                              result);
    for (const unsigned int q : values.quadrature_point_indices())
      result[q] = functions.value(k, values.quadrature_point(q)) - result[q];
  }



  void
  SingularShapes::gradients(const unsigned int         k,
                            const FEValuesBase<2>     &values,
                            std::vector<Tensor<2, 2>> &result) const
  {
    result.resize(values.n_quadrature_points);
    values[FEValuesExtractors::Vector(0)].get_function_gradients(
      interpolated[k], result);
    for (const unsigned int q : values.quadrature_point_indices())
      result[q] = functions.gradient(k, values.quadrature_point(q)) - result[q];
  }
} // namespace Crevasse
