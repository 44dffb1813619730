// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/linear/stiffness_operator.h>

#include <deal.II/base/utilities.h>
#include <deal.II/matrix_free/fe_evaluation.h>

#include <algorithm>
#include <map>
#include <set>

namespace Crevasse
{
  using namespace dealii;

  template <int dim>
  typename StiffnessOperator<dim>::Moduli
  StiffnessOperator<dim>::moduli_of(
    const Space<dim>                    &space,
    const QuadratureField<dim>          &points,
    const PointValues<VoigtMatrix<dim>> &stiffness)
  {
    const bool with_out_of_plane =
      space.volumetric_strain() == VolumetricStrain::mean;
    bool is_isotropic = true;
    for (const VoigtMatrix<dim> &K : stiffness.distinct())
      is_isotropic =
        is_isotropic && IsotropicModuli<dim>::represents(K, with_out_of_plane);
    const auto to = [&](const auto pack) -> Moduli {
      return transform(stiffness, points.n_local_points(), pack);
    };
    if (Utilities::MPI::min(is_isotropic ? 1 : 0, space.communicator()) == 1)
      return to([](const auto &K) { return IsotropicModuli<dim>(K); });
    return to([](const auto &K) { return GeneralModuli<dim>(K); });
  }



  template <int dim>
  StiffnessOperator<dim>::StiffnessOperator(
    const Space<dim>                    &space,
    const QuadratureField<dim>          &points,
    const PointValues<VoigtMatrix<dim>> &stiffness)
    : space(space)
    , loops(space.matrix_free())
    , moduli(moduli_of(space, points, stiffness))
    , constrained_rows(loops->get_constrained_dofs())
  {
    std::sort(constrained_rows.begin(), constrained_rows.end());
    if (!stiffness.is_uniform())
      {
        first_points.resize(loops->n_cell_batches());
        for (unsigned int batch = 0; batch < first_points.size(); ++batch)
          for (unsigned int lane = 0;
               lane < loops->n_active_entries_per_cell_batch(batch);
               ++lane)
            first_points[batch][lane] =
              points.offset(loops->get_cell_iterator(batch, lane)) /
              n_components;
      }
    compute_diagonal();
  }



  template <int dim>
  template <typename PointModuli>
  void
  StiffnessOperator<dim>::multiply(
    const PointValues<PointModuli>         &moduli,
    const unsigned int                      batch,
    const unsigned int                      point,
    const std::array<Number, n_components> &strain,
    std::array<Number, n_components>       &stress) const
  {
    if (moduli.is_uniform())
      PointModuli::multiply(moduli[0].values, strain, stress);
    else if constexpr (Number::size() == 1)
      PointModuli::multiply(moduli[first_points[batch][0] + point].values,
                            strain,
                            stress);
    else
      {
        std::array<Number, PointModuli::n_values> of_lanes{};
        for (unsigned int lane = 0;
             lane < loops->n_active_entries_per_cell_batch(batch);
             ++lane)
          {
            const auto &values =
              moduli[first_points[batch][lane] + point].values;
            for (unsigned int k = 0; k < values.size(); ++k)
              of_lanes[k][lane] = values[k];
          }
        PointModuli::multiply(of_lanes, strain, stress);
      }
  }



  template <int dim>
  template <bool mean_volume, typename PointModuli, typename Evaluation>
  void
  StiffnessOperator<dim>::multiply_at_points(
    const PointValues<PointModuli> &moduli,
    const unsigned int              batch,
    Evaluation                     &evaluation) const
  {
    constexpr unsigned int           n_points = Evaluation::static_n_q_points;
    std::array<Number, n_components> strain{}, stress{};
    std::array<SymmetricTensor<2, dim, Number>, n_points> stresses;
    Number volume(0.), dilatation(0.), pressure(0.);
    if constexpr (mean_volume)
      {
        for (unsigned int q = 0; q < n_points; ++q)
          {
            dilatation += evaluation.get_divergence(q) * evaluation.JxW(q);
            volume += evaluation.JxW(q);
          }
        dilatation /= volume;
      }
    for (unsigned int q = 0; q < n_points; ++q)
      {
        const auto gradient = evaluation.get_symmetric_gradient(q);
        for (unsigned int i = 0; i < dim; ++i)
          for (unsigned int j = i; j < dim; ++j)
            strain[voigt_index<dim>(i, j)] =
              (i == j ? 1. : 2.) * gradient[i][j];
        if constexpr (mean_volume)
          {
            const Number added = (dilatation - trace(gradient)) / 3.;
            for (unsigned int i = 0; i < dim; ++i)
              strain[i] += added;
            if constexpr (dim == 2)
              strain[2] = added;
          }
        multiply(moduli, batch, q, strain, stress);
        for (unsigned int i = 0; i < dim; ++i)
          for (unsigned int j = i; j < dim; ++j)
            stresses[q][i][j] = stress[voigt_index<dim>(i, j)];
        if constexpr (mean_volume)
          {
            // The mean over the cell follows when it is known.
            const Number own = (stress[0] + stress[1] + stress[2]) / 3.;
            pressure += own * evaluation.JxW(q);
            for (unsigned int i = 0; i < dim; ++i)
              stresses[q][i][i] -= own;
          }
        else
          evaluation.submit_symmetric_gradient(stresses[q], q);
      }
    if constexpr (mean_volume)
      for (unsigned int q = 0; q < n_points; ++q)
        {
          for (unsigned int i = 0; i < dim; ++i)
            stresses[q][i][i] += pressure / volume;
          evaluation.submit_symmetric_gradient(stresses[q], q);
        }
  }



  template <int dim>
  template <int degree, bool mean_volume>
  void
  StiffnessOperator<dim>::apply(
    const Loops                                 &loops,
    Vector                                      &result,
    const Vector                                &v,
    const std::pair<unsigned int, unsigned int> &cells) const
  {
    FEEvaluation<dim, degree, degree + 1, dim, double> evaluation(loops);
    std::visit(
      [&](const auto &of_points) {
        for (unsigned int batch = cells.first; batch < cells.second; ++batch)
          {
            evaluation.reinit(batch);
            evaluation.gather_evaluate(v, EvaluationFlags::gradients);
            this->template multiply_at_points<mean_volume>(of_points,
                                                           batch,
                                                           evaluation);
            evaluation.integrate_scatter(EvaluationFlags::gradients, result);
          }
      },
      moduli);
  }



  template <int dim>
  void
  StiffnessOperator<dim>::vmult(Vector              &result,
                                const Vector        &v,
                                const RangeFunction &before,
                                const RangeFunction &after) const
  {
    const auto identity_then_after = [&](const unsigned int begin,
                                         const unsigned int end) {
      for (const auto *rows : {&constrained_rows, held_rows})
        if (rows != nullptr)
          for (auto row = std::lower_bound(rows->begin(), rows->end(), begin);
               row != rows->end() && *row < end;
               ++row)
            result.local_element(*row) = v.local_element(*row);
      if (after)
        after(begin, end);
    };
    const auto loop = [&](const auto function) {
      loops->cell_loop(function, this, result, v, before, identity_then_after);
    };
    if (space.finite_element().degree == 2)
      loop(&StiffnessOperator::apply<2, false>);
    else if (space.volumetric_strain() == VolumetricStrain::mean)
      loop(&StiffnessOperator::apply<1, true>);
    else
      loop(&StiffnessOperator::apply<1, false>);
  }



  template <int dim>
  template <int degree, bool mean_volume>
  void
  StiffnessOperator<dim>::add_cell_diagonals()
  {
    FEEvaluation<dim, degree, degree + 1, dim, double> evaluation(*loops);
    const unsigned int  n = space.finite_element().n_dofs_per_cell();
    std::vector<Number> entries(n);
    std::vector<types::global_dof_index> dofs(n);
    const auto &numbering = loops->get_shape_info().lexicographic_numbering;
    for (unsigned int batch = 0; batch < loops->n_cell_batches(); ++batch)
      {
        evaluation.reinit(batch);
        for (unsigned int i = 0; i < n; ++i)
          {
            Number *const values = evaluation.begin_dof_values();
            std::fill_n(values, n, Number(0.));
            values[i] = 1.;
            evaluation.evaluate(EvaluationFlags::gradients);
            std::visit(
              [&](const auto &of_points) {
                this->template multiply_at_points<mean_volume>(of_points,
                                                               batch,
                                                               evaluation);
              },
              moduli);
            evaluation.integrate(EvaluationFlags::gradients);
            entries[i] = values[i];
          }
        for (unsigned int lane = 0;
             lane < loops->n_active_entries_per_cell_batch(batch);
             ++lane)
          {
            loops->get_cell_iterator(batch, lane)->get_dof_indices(dofs);
            for (unsigned int i = 0; i < n; ++i)
              if (const auto *masters =
                    space.constraints().get_constraint_entries(
                      dofs[numbering[i]]))
                for (const auto &[master, factor] : *masters)
                  operator_diagonal(master) +=
                    factor * factor * entries[i][lane];
              else
                operator_diagonal(dofs[numbering[i]]) += entries[i][lane];
          }
      }
  }



  template <int dim>
  void
  StiffnessOperator<dim>::compute_diagonal()
  {
    initialize_dof_vector(operator_diagonal);
    if (space.finite_element().degree == 2)
      add_cell_diagonals<2, false>();
    else if (space.volumetric_strain() == VolumetricStrain::mean)
      add_cell_diagonals<1, true>();
    else
      add_cell_diagonals<1, false>();
    operator_diagonal.compress(VectorOperation::add);
    for (const unsigned int row : constrained_rows)
      operator_diagonal.local_element(row) = 1.;
  }



  template <int dim>
  void
  StiffnessOperator<dim>::vmult(Vector &result, const Vector &v) const
  {
    const auto is_ours = [this](const Vector &vector) {
      return vector.get_partitioner() == operator_diagonal.get_partitioner();
    };
    if (!is_ours(v) || !is_ours(result))
      {
        copy_of_v.reinit(operator_diagonal, true);
        copy_of_result.reinit(operator_diagonal, true);
        copy_of_v.copy_locally_owned_data_from(v);
        vmult(copy_of_result, copy_of_v);
        result.copy_locally_owned_data_from(copy_of_result);
        return;
      }
    vmult(result,
          v,
          [&](const unsigned int begin, const unsigned int end) {
            std::fill(result.begin() + begin, result.begin() + end, 0.);
          },
          {});
  }



  template <int dim>
  std::vector<LinearOperator::Indices>
  StiffnessOperator<dim>::couplings(
    const LinearOperator::Indices &rows,
    const LinearOperator::Indices &columns) const
  {
    // Of columns, among which the rows are.
    std::map<types::global_dof_index, std::set<types::global_dof_index>> all;
    LinearOperator::Indices of_cell, found;
    for (const auto &cell : space.dof_handler().active_cell_iterators())
      {
        if (cell->is_artificial())
          continue;
        space.get_unknowns(cell, of_cell);
        found.clear();
        const auto note = [&](const types::global_dof_index dof) {
          if (std::binary_search(columns.begin(), columns.end(), dof))
            found.push_back(dof);
        };
        for (const auto dof : of_cell)
          if (const auto *masters =
                space.constraints().get_constraint_entries(dof))
            for (const auto &master : *masters)
              note(master.first);
          else
            note(dof);
        for (const auto dof : found)
          all[dof].insert(found.begin(), found.end());
      }

    std::vector<LinearOperator::Indices> coupled(rows.size());
    for (std::size_t k = 0; k < rows.size(); ++k)
      for (const auto dof : all[rows[k]])
        if (dof != rows[k])
          coupled[k].push_back(dof);
    return coupled;
  }



  template <int dim>
  std::size_t
  StiffnessOperator<dim>::memory_consumption() const
  {
    return std::visit(
             [](const auto &of_points) {
               return of_points.memory_consumption();
             },
             moduli) +
           first_points.size() * sizeof(first_points[0]) +
           constrained_rows.size() * sizeof(unsigned int) +
           operator_diagonal.memory_consumption() +
           copy_of_v.memory_consumption() + copy_of_result.memory_consumption();
  }



  template class StiffnessOperator<2>;
  template class StiffnessOperator<3>;
} // namespace Crevasse
