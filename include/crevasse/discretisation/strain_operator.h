// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_discretisation_strain_operator_h
#define crevasse_discretisation_strain_operator_h

#include <crevasse/discretisation/enrichment.h>
#include <crevasse/discretisation/quadrature_field.h>
#include <crevasse/discretisation/space.h>

#include <deal.II/matrix_free/fe_evaluation.h>
#include <deal.II/matrix_free/matrix_free.h>

#include <array>
#include <memory>
#include <vector>

namespace Crevasse
{
  /**
   * The strain operator D of the paper (formula (2) without e⁰) and its
   * transpose, the equilibrium operator, between displacements and values at
   * quadrature points. Both are matrix-free; what happens at a point is passed
   * in as a function, so that a field is read or written once per sweep.
   *
   * With VolumetricStrain::mean, the trace of the strain at each point is the
   * mean over its cell, and a third of the difference goes to each of the
   * components 11, 22 and 33. The transpose gives a point the mean pressure of
   * the cell instead of its own.
   *
   * With singular functions, displacements carry their coefficients, and the
   * cells near the tip are not MatrixFree's: see Enrichment. Its work space
   * makes an operator one that only one thread at a time can apply.
   */
  template <int dim>
  class StrainOperator
  {
  public:
    /** @param space must outlive this object. */
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

    /** Degree and rule are known when the program is compiled, but not with
     * singular functions. */
    static constexpr int run_time = -1;
    template <int degree>
    using Evaluation = dealii::FEEvaluation<dim,
                                            degree,
                                            degree == run_time ? 0 : degree + 1,
                                            dim,
                                            double>;

    /** Points of a cell at most: degree 2 with singular functions. */
    template <int degree>
    static constexpr unsigned int
    most_points()
    {
      return dealii::Utilities::pow(degree == run_time ? 4 : degree + 1, dim);
    }

    template <int degree, bool mean_volume, typename Function>
    void
    strain_sweep(const Vector &displacement, const Function &f) const;

    template <int degree, bool mean_volume, typename Function>
    void
    transpose_sweep(Vector &force, const Function &stress_at) const;

    /** The mean of f(q) over the points of each cell of a batch. */
    template <typename CellEvaluation, typename Function>
    Number
    cell_mean(const CellEvaluation &evaluation, const Function &f) const;

    /** Whether the cells of a batch are MatrixFree's: see
     * Space::matrix_free(). */
    bool
    has_batch(const unsigned int batch) const
    {
      return enrichment == nullptr ||
             matrix_free->get_cell_category(batch) == 0;
    }

    const Space<dim>           &space;
    const unsigned int          degree;
    const unsigned int          n_cell_points;
    const bool                  mean_volume;
    std::unique_ptr<Enrichment> enrichment; ///< by singular functions
    const std::shared_ptr<const dealii::MatrixFree<dim, double>> matrix_free;

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
    if constexpr (dim == 2)
      if (enrichment != nullptr)
        {
          enrichment->read(displacement);
          const auto enriched = [&](const std::size_t       offset,
                                    const VoigtVector<dim> &strain) {
            f(offset, strain + enrichment->strain(offset));
          };
          strain_sweep<run_time, false>(enrichment->nodal_part(), enriched);
          enrichment->for_each_special_strain(enriched);
          displacement.zero_out_ghost_values();
          return;
        }
    if (mean_volume)
      strain_sweep<1, true>(displacement, f);
    else if (degree == 1)
      strain_sweep<1, false>(displacement, f);
    else
      strain_sweep<2, false>(displacement, f);
    displacement.zero_out_ghost_values();
  }



  template <int dim>
  template <typename Function>
  void
  StrainOperator<dim>::add_transpose(Vector         &force,
                                     const Function &stress_at) const
  {
    if constexpr (dim == 2)
      if (enrichment != nullptr)
        {
          enrichment->begin_transpose();
          const auto enriched = [&](const std::size_t offset) {
            const VoigtVector<dim> stress = stress_at(offset);
            enrichment->add_stress(offset, stress);
            return stress;
          };
          transpose_sweep<run_time, false>(enrichment->nodal_part(), enriched);
          enrichment->add_special_transpose(enriched);
          enrichment->end_transpose(force);
          return;
        }
    if (mean_volume)
      transpose_sweep<1, true>(force, stress_at);
    else if (degree == 1)
      transpose_sweep<1, false>(force, stress_at);
    else
      transpose_sweep<2, false>(force, stress_at);
    force.compress(dealii::VectorOperation::add);
  }



  template <int dim>
  template <typename CellEvaluation, typename Function>
  typename StrainOperator<dim>::Number
  StrainOperator<dim>::cell_mean(const CellEvaluation &evaluation,
                                 const Function       &f) const
  {
    Number integral(0.), volume(0.);
    for (unsigned int q = 0; q < n_cell_points; ++q)
      {
        integral += f(q) * evaluation.JxW(q);
        volume += evaluation.JxW(q);
      }
    return integral / volume;
  }



  template <int dim>
  template <int degree, bool mean_volume, typename Function>
  void
  StrainOperator<dim>::strain_sweep(const Vector   &displacement,
                                    const Function &f) const
  {
    Evaluation<degree> evaluation(*matrix_free);
    for (unsigned int batch = 0; batch < matrix_free->n_cell_batches(); ++batch)
      {
        if (!has_batch(batch))
          continue;
        evaluation.reinit(batch);
        evaluation.gather_evaluate(displacement,
                                   dealii::EvaluationFlags::gradients);
        Number mean(0.);
        if constexpr (mean_volume)
          mean = cell_mean(evaluation, [&](const unsigned int q) {
            return evaluation.get_divergence(q);
          });
        for (unsigned int q = 0; q < n_cell_points; ++q)
          {
            const auto gradient = evaluation.get_symmetric_gradient(q);
            Number     added(0.); // to each of the three diagonal components
            if constexpr (mean_volume)
              added = (mean - trace(gradient)) / 3.;
            for (unsigned int lane = 0;
                 lane < matrix_free->n_active_entries_per_cell_batch(batch);
                 ++lane)
              {
                VoigtVector<dim> strain;
                for (unsigned int i = 0; i < dim; ++i)
                  for (unsigned int j = i; j < dim; ++j)
                    strain[voigt_index<dim>(i, j)] =
                      (i == j ? 1. : 2.) * gradient[i][j][lane];
                if constexpr (mean_volume)
                  for (unsigned int i = 0; i < 3; ++i)
                    strain[i] += added[lane];
                f(batch_offsets[batch][lane] + q * n_stress_components<dim>,
                  strain);
              }
          }
      }
  }



  template <int dim>
  template <int degree, bool mean_volume, typename Function>
  void
  StrainOperator<dim>::transpose_sweep(Vector         &force,
                                       const Function &stress_at) const
  {
    const unsigned int n_points = n_cell_points;
    std::array<dealii::SymmetricTensor<2, dim, Number>, most_points<degree>()>
                                              stress{};
    std::array<Number, most_points<degree>()> pressure{};

    Evaluation<degree> evaluation(*matrix_free);
    for (unsigned int batch = 0; batch < matrix_free->n_cell_batches(); ++batch)
      {
        if (!has_batch(batch))
          continue;
        evaluation.reinit(batch);
        for (unsigned int q = 0; q < n_points; ++q)
          for (unsigned int lane = 0;
               lane < matrix_free->n_active_entries_per_cell_batch(batch);
               ++lane)
            {
              const VoigtVector<dim> s = stress_at(
                batch_offsets[batch][lane] + q * n_stress_components<dim>);
              for (unsigned int i = 0; i < dim; ++i)
                for (unsigned int j = i; j < dim; ++j)
                  stress[q][i][j][lane] = s[voigt_index<dim>(i, j)];
              if constexpr (mean_volume)
                pressure[q][lane] = (s[0] + s[1] + s[2]) / 3.;
            }
        if constexpr (mean_volume)
          {
            const Number mean =
              cell_mean(evaluation,
                        [&](const unsigned int q) { return pressure[q]; });
            for (unsigned int q = 0; q < n_points; ++q)
              for (unsigned int i = 0; i < dim; ++i)
                stress[q][i][i] += mean - pressure[q];
          }
        for (unsigned int q = 0; q < n_points; ++q)
          evaluation.submit_symmetric_gradient(stress[q], q);
        evaluation.integrate_scatter(dealii::EvaluationFlags::gradients, force);
      }
  }
} // namespace Crevasse

#endif
