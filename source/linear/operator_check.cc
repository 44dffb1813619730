// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/problems.h>
#include <crevasse/base/text.h>
#include <crevasse/discretisation/strain_operator.h>
#include <crevasse/linear/operator_check.h>


namespace Crevasse
{
  using namespace dealii;

  template <int dim>
  void
  require_same_product(const StiffnessOperator<dim>        &A,
                       const Space<dim>                    &space,
                       const QuadratureField<dim>          &points,
                       const PointValues<VoigtMatrix<dim>> &stiffness)
  {
    constexpr double          tolerance = 1e-10;
    const StrainOperator<dim> D(space, points);
    Vector                    v, product, force, stress;
    for (Vector *vector : {&v, &product, &force})
      D.initialize(*vector);
    for (const auto i : v.locally_owned_elements())
      if (!space.constraints.is_constrained(i))
        v(i) = std::sin(1e4 * std::sin(1. + i));
    A.vmult(product, v);
    points.initialize(stress);
    D.for_each_strain(
      v, [&](const std::size_t offset, const VoigtVector<dim> &strain) {
        const std::size_t point = offset / n_stress_components<dim>;
        points.set(stress, offset, stiffness[point] * strain);
      });
    D.add_transpose(force, [&](const std::size_t offset) {
      return points.get(stress, offset);
    });

    force.add(-1., product);
    const double size  = product.l2_norm();
    const double error = force.l2_norm();
    if (!(error <= tolerance * size))
      throw NumericalError(
        "The matrix-free product with the stiffness differs from that of "
        "strains and stresses by " +
        Text::from_number(error / size) + " (allowed " +
        Text::from_number(tolerance) +
        "): an error of the program or of its compilation. Use [Linear solver] "
        "Type = amg, cholesky or mumps, and report it.");
  }



  template void
  require_same_product<2>(const StiffnessOperator<2> &,
                          const Space<2> &,
                          const QuadratureField<2> &,
                          const PointValues<VoigtMatrix<2>> &);
  template void
  require_same_product<3>(const StiffnessOperator<3> &,
                          const Space<3> &,
                          const QuadratureField<3> &,
                          const PointValues<VoigtMatrix<3>> &);
} // namespace Crevasse
