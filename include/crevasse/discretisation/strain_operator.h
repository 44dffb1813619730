// ---------------------------------------------------------------------
//
// Copyright (C) 2026 by the Crevasse authors
//
// This file is part of Crevasse. It is free software; you can use it,
// redistribute it and/or modify it under the terms of the GNU Lesser
// General Public License as published by the Free Software Foundation;
// either version 2.1 of the License, or (at your option) any later version.
//
// ---------------------------------------------------------------------

#ifndef crevasse_discretisation_strain_operator_h
#define crevasse_discretisation_strain_operator_h

#include <crevasse/discretisation/quadrature_field.h>
#include <crevasse/discretisation/space.h>

#include <deal.II/matrix_free/fe_evaluation.h>
#include <deal.II/matrix_free/matrix_free.h>

namespace Crevasse
{
  /**
   * The strain operator D of the paper (formula (2) without e⁰) and its
   * transpose, the equilibrium operator, between displacements and values at
   * quadrature points. Both are matrix-free; what happens at a point is passed
   * in as a function, so that a field is read or written once per sweep.
   */
  template <int dim>
  class StrainOperator
  {
  public:
    StrainOperator(const Space<dim> &space, const QuadratureField<dim> &points);

    /** Gives @p displacement the layout that D reads, all zero. */
    void
    initialize(Vector &displacement) const;

    /**
     * For each point calls `f(offset, strain)` with the place of the point in
     * a QuadratureField and the strain D q there. Constrained entries of @p
     * displacement are not read but resolved.
     */
    template <typename Function>
    void
    for_each_strain(const Vector &displacement, const Function &f) const;

    /** force += ∫ Dᵀ s for the stress `s(offset)` at each point. */
    template <typename Function>
    void
    add_transpose(Vector &force, const Function &stress_at) const;

  private:
    using Number = dealii::VectorizedArray<double>;

    template <int degree>
    using Evaluation =
      dealii::FEEvaluation<dim, degree, degree + 1, dim, double>;

    template <int degree, typename Function>
    void
    strain_sweep(const Vector &displacement, const Function &f) const;

    template <int degree, typename Function>
    void
    transpose_sweep(Vector &force, const Function &stress_at) const;

    const unsigned int              degree;
    const unsigned int              n_cell_points;
    dealii::MatrixFree<dim, double> matrix_free;

    /** Where the points of each lane of each cell batch begin. */
    std::vector<std::array<std::size_t, Number::size()>> batch_offsets;
  };



  template <int dim>
  template <typename Function>
  void
  StrainOperator<dim>::for_each_strain(const Vector   &displacement,
                                       const Function &f) const
  {
    displacement.update_ghost_values();
    if (degree == 1)
      strain_sweep<1>(displacement, f);
    else
      strain_sweep<2>(displacement, f);
    displacement.zero_out_ghost_values();
  }



  template <int dim>
  template <typename Function>
  void
  StrainOperator<dim>::add_transpose(Vector         &force,
                                     const Function &stress_at) const
  {
    if (degree == 1)
      transpose_sweep<1>(force, stress_at);
    else
      transpose_sweep<2>(force, stress_at);
    force.compress(dealii::VectorOperation::add);
  }



  template <int dim>
  template <int degree, typename Function>
  void
  StrainOperator<dim>::strain_sweep(const Vector   &displacement,
                                    const Function &f) const
  {
    Evaluation<degree> evaluation(matrix_free);
    for (unsigned int batch = 0; batch < matrix_free.n_cell_batches(); ++batch)
      {
        evaluation.reinit(batch);
        evaluation.gather_evaluate(displacement,
                                   dealii::EvaluationFlags::gradients);
        for (unsigned int q = 0; q < n_cell_points; ++q)
          {
            const auto gradient = evaluation.get_symmetric_gradient(q);
            for (unsigned int lane = 0;
                 lane < matrix_free.n_active_entries_per_cell_batch(batch);
                 ++lane)
              {
                VoigtVector<dim> strain;
                for (unsigned int i = 0; i < dim; ++i)
                  for (unsigned int j = i; j < dim; ++j)
                    strain[voigt_index<dim>(i, j)] =
                      (i == j ? 1. : 2.) * gradient[i][j][lane];
                f(batch_offsets[batch][lane] + q * n_stress_components<dim>,
                  strain);
              }
          }
      }
  }



  template <int dim>
  template <int degree, typename Function>
  void
  StrainOperator<dim>::transpose_sweep(Vector         &force,
                                       const Function &stress_at) const
  {
    Evaluation<degree> evaluation(matrix_free);
    for (unsigned int batch = 0; batch < matrix_free.n_cell_batches(); ++batch)
      {
        evaluation.reinit(batch);
        for (unsigned int q = 0; q < n_cell_points; ++q)
          {
            dealii::SymmetricTensor<2, dim, Number> stress;
            for (unsigned int lane = 0;
                 lane < matrix_free.n_active_entries_per_cell_batch(batch);
                 ++lane)
              {
                const VoigtVector<dim> s = stress_at(
                  batch_offsets[batch][lane] + q * n_stress_components<dim>);
                for (unsigned int i = 0; i < dim; ++i)
                  for (unsigned int j = i; j < dim; ++j)
                    stress[i][j][lane] = s[voigt_index<dim>(i, j)];
              }
            evaluation.submit_symmetric_gradient(stress, q);
          }
        evaluation.integrate_scatter(dealii::EvaluationFlags::gradients, force);
      }
  }
} // namespace Crevasse

#endif
