// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_discretisation_strain_operator_h
#define crevasse_discretisation_strain_operator_h

#include <crevasse/discretisation/quadrature_field.h>
#include <crevasse/discretisation/shape_strains.h>
#include <crevasse/discretisation/space.h>

#include <deal.II/matrix_free/fe_evaluation.h>
#include <deal.II/matrix_free/matrix_free.h>

#include <array>

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
   * cells near the tip have rules that are none of MatrixFree's: the strains of
   * all shape functions are stored instead.
   */
  template <int dim>
  class StrainOperator
  {
  public:
    /** All arguments must outlive this object. */
    StrainOperator(const Space<dim> &space, const QuadratureField<dim> &points)
      : space(space)
      , degree(space.finite_element().degree)
      , n_cell_points(space.quadratures()[0].size())
      , mean_volume(space.volumetric_strain() == VolumetricStrain::mean)
    {
      Assert(degree == 1 || degree == 2, dealii::ExcNotImplemented());

      if (space.singular_shapes() != nullptr)
        {
          ShapeStrains<dim> shapes(space);
          for (const auto &cell : owned_cells(space.dof_handler()))
            {
              const dealii::FEValues<dim> &values = shapes.reinit(cell);
              StoredCell                   stored;
              stored.offset  = points.offset(cell);
              stored.weights = values.get_JxW_values();
              stored.strains.resize(stored.weights.size());
              space.get_unknowns(cell, stored.unknowns);
              for (const unsigned int q : values.quadrature_point_indices())
                shapes.at_point(q, stored.strains[q]);
              stored_cells.push_back(std::move(stored));
            }
          return;
        }
      matrix_free = space.matrix_free();
      batch_offsets.resize(matrix_free->n_cell_batches());
      for (unsigned int batch = 0; batch < batch_offsets.size(); ++batch)
        for (unsigned int lane = 0;
             lane < matrix_free->n_active_entries_per_cell_batch(batch);
             ++lane)
          batch_offsets[batch][lane] =
            points.offset(matrix_free->get_cell_iterator(batch, lane));
    }

    /** Gives @p displacement the layout that D reads, all zero. */
    void
    initialize(Vector &displacement) const
    {
      if (matrix_free == nullptr)
        displacement = space.ghosted_vector();
      else
        matrix_free->initialize_dof_vector(displacement);
    }

    /**
     * For each point calls `f(offset, strain)` with the place of the point in
     * a QuadratureField and the strain D q there. Constrained entries of @p
     * displacement are not read but resolved.
     */
    template <typename Function>
    void
    for_each_strain(const Vector &displacement, const Function &f) const
    {
      displacement.update_ghost_values();
      if (matrix_free == nullptr)
        stored_strains(displacement, f);
      else if (mean_volume)
        strain_sweep<1, true>(displacement, f);
      else if (degree == 1)
        strain_sweep<1, false>(displacement, f);
      else
        strain_sweep<2, false>(displacement, f);
      displacement.zero_out_ghost_values();
    }

    /** force += ∫ Dᵀ s for the stress `s(offset)` at each point. */
    template <typename Function>
    void
    add_transpose(Vector &force, const Function &stress_at) const
    {
      if (matrix_free == nullptr)
        stored_transpose(force, stress_at);
      else if (mean_volume)
        transpose_sweep<1, true>(force, stress_at);
      else if (degree == 1)
        transpose_sweep<1, false>(force, stress_at);
      else
        transpose_sweep<2, false>(force, stress_at);
      force.compress(dealii::VectorOperation::add);
    }

  private:
    using Number = dealii::VectorizedArray<double>;

    template <int degree>
    using Evaluation =
      dealii::FEEvaluation<dim, degree, degree + 1, dim, double>;

    /** A cell where there are singular functions. */
    struct StoredCell
    {
      std::size_t                                  offset;
      std::vector<dealii::types::global_dof_index> unknowns;
      std::vector<double>                          weights; ///< of its points
      std::vector<std::vector<VoigtVector<dim>>>
        strains; ///< of each unknown, by point
    };

    /** The mean of f(q) over the points of each cell of a batch. */
    template <typename CellEvaluation, typename Function>
    Number
    cell_mean(const CellEvaluation &evaluation, const Function &f) const
    {
      Number integral(0.), volume(0.);
      for (unsigned int q = 0; q < n_cell_points; ++q)
        {
          integral += f(q) * evaluation.JxW(q);
          volume += evaluation.JxW(q);
        }
      return integral / volume;
    }

    template <int degree, bool mean_volume, typename Function>
    void
    strain_sweep(const Vector &displacement, const Function &f) const
    {
      Evaluation<degree> evaluation(*matrix_free);
      for (unsigned int batch = 0; batch < batch_offsets.size(); ++batch)
        {
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

    template <int degree, bool mean_volume, typename Function>
    void
    transpose_sweep(Vector &force, const Function &stress_at) const
    {
      constexpr unsigned int most_points =
        dealii::Utilities::pow(degree + 1, dim);
      std::array<dealii::SymmetricTensor<2, dim, Number>, most_points> stress{};
      std::array<Number, most_points> pressure{};

      Evaluation<degree> evaluation(*matrix_free);
      for (unsigned int batch = 0; batch < batch_offsets.size(); ++batch)
        {
          evaluation.reinit(batch);
          for (unsigned int q = 0; q < n_cell_points; ++q)
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
              for (unsigned int q = 0; q < n_cell_points; ++q)
                for (unsigned int i = 0; i < dim; ++i)
                  stress[q][i][i] += mean - pressure[q];
            }
          for (unsigned int q = 0; q < n_cell_points; ++q)
            evaluation.submit_symmetric_gradient(stress[q], q);
          evaluation.integrate_scatter(dealii::EvaluationFlags::gradients,
                                       force);
        }
    }

    template <typename Function>
    void
    stored_strains(const Vector &displacement, const Function &f) const
    {
      std::vector<double> values;
      for (const StoredCell &cell : stored_cells)
        {
          values.resize(cell.unknowns.size());
          space.constraints().get_dof_values(displacement,
                                             cell.unknowns.begin(),
                                             values.begin(),
                                             values.end());
          for (unsigned int q = 0; q < cell.weights.size(); ++q)
            {
              VoigtVector<dim> strain;
              for (unsigned int i = 0; i < values.size(); ++i)
                strain += values[i] * cell.strains[q][i];
              f(cell.offset + q * n_stress_components<dim>, strain);
            }
        }
    }

    template <typename Function>
    void
    stored_transpose(Vector &force, const Function &stress_at) const
    {
      std::vector<double> forces;
      for (const StoredCell &cell : stored_cells)
        {
          forces.assign(cell.unknowns.size(), 0.);
          for (unsigned int q = 0; q < cell.weights.size(); ++q)
            {
              const VoigtVector<dim> stress =
                cell.weights[q] *
                stress_at(cell.offset + q * n_stress_components<dim>);
              for (unsigned int i = 0; i < forces.size(); ++i)
                forces[i] += stress * cell.strains[q][i];
            }
          space.constraints().distribute_local_to_global(forces.begin(),
                                                         forces.end(),
                                                         cell.unknowns.begin(),
                                                         force);
        }
    }

    const Space<dim>       &space;
    const unsigned int      degree;
    const unsigned int      n_cell_points;
    const bool              mean_volume;
    std::vector<StoredCell> stored_cells;
    std::shared_ptr<const dealii::MatrixFree<dim, double>>
      matrix_free; ///< null: cells are stored

    /** Where the points of each lane of each cell batch begin. */
    std::vector<std::array<std::size_t, Number::size()>> batch_offsets;
  };
} // namespace Crevasse

#endif
