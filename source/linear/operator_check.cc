// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/problems.h>
#include <crevasse/base/text.h>
#include <crevasse/discretisation/stiffness.h>
#include <crevasse/discretisation/strain_operator.h>
#include <crevasse/linear/operator_check.h>

namespace Crevasse
{
  using namespace dealii;

  namespace
  {
    /** Sets @p stress to zero except in up to 100 cells of this rank.
     *
     * @return ∫ stress : D v in these cells, with D of the assembly: A and
     * StrainOperator share geometry and constraints. */
    template <int dim>
    double
    work_in_some_cells(const Space<dim>           &space,
                       const QuadratureField<dim> &points,
                       const Vector               &v,
                       Vector                     &stress)
    {
      const unsigned int stride = 1 + space.mesh().n_active_cells() / 100;
      ShapeStrains<dim>  shapes(space);
      Vector             kept;
      points.initialize(kept);
      std::vector<VoigtVector<dim>>        strains;
      std::vector<types::global_dof_index> indices;
      std::vector<double>                  values;
      double                               work = 0.;
      unsigned int                         k    = 0;
      v.update_ghost_values();
      for (const auto &cell : owned_cells(space.dof_handler))
        if (k++ % stride == 0)
          {
            const FEValues<dim> &fe_values = shapes.reinit(cell);
            space.get_unknowns(cell, indices);
            values.resize(indices.size());
            space.constraints.get_dof_values(v,
                                             indices.begin(),
                                             values.begin(),
                                             values.end());
            std::size_t offset = points.offset(cell);
            for (const unsigned int q : fe_values.quadrature_point_indices())
              {
                const VoigtVector<dim> s = points.get(stress, offset);
                shapes.at_point(q, strains);
                for (unsigned int i = 0; i < values.size(); ++i)
                  work += values[i] * (s * strains[i]) * fe_values.JxW(q);
                points.set(kept, offset, s);
                offset += n_stress_components<dim>;
              }
          }
      v.zero_out_ghost_values();
      stress.swap(kept);
      return Utilities::MPI::sum(work, space.communicator());
    }



    void
    require_small(const double error, const double size, const double tolerance)
    {
      if (!(error <= tolerance * size))
        throw NumericalError(
          "The matrix-free product with the stiffness differs from that of "
          "strains and stresses by " +
          Text::from_number(error / size, 3) + " (allowed " +
          Text::from_number(tolerance) +
          "): an error of the program or of its compilation. Use [Linear "
          "solver] Type = amg, cholesky or mumps, and report it.");
    }
  } // namespace



  template <int dim>
  void
  require_same_product(const StiffnessOperator<dim>        &A,
                       const Space<dim>                    &space,
                       const QuadratureField<dim>          &points,
                       const PointValues<VoigtMatrix<dim>> &stiffness)
  {
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
    const auto stress_at = [&](const std::size_t offset) {
      return points.get(stress, offset);
    };
    D.add_transpose(force, stress_at);
    force.add(-1., product);
    require_small(force.l2_norm(), product.l2_norm(), 1e-10);

    // Rounding of vertices may cost six digits of the sizes of small cells.
    const double work = work_in_some_cells(space, points, v, stress);
    force             = 0.;
    D.add_transpose(force, stress_at);
    require_small(std::abs(force * v - work), work, 1e-9);
  }



  template decltype(require_same_product<2>) require_same_product<2>;
  template decltype(require_same_product<3>) require_same_product<3>;
} // namespace Crevasse
