// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/linear/stiffness_operator.h>

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/matrix_free/fe_evaluation.h>

#include <numeric>

namespace Crevasse
{
  using namespace dealii;

  namespace
  {
    /** Of a shape function's component c the strain ε depends on the gradient
     * and, with mean dilatations, on the mean of its derivative by x_c: εᵀKε is
     * this form of these dim + 1 numbers. */
    template <int dim>
    using EnergyForm = std::array<std::array<double, dim + 1>, dim + 1>;



    template <int dim, typename PointModuli>
    std::array<EnergyForm<dim>, dim>
    energy_forms(const PointModuli &moduli, const bool mean_volume)
    {
      using Components = std::array<double, n_stress_components<dim>>;
      std::array<EnergyForm<dim>, dim> forms;
      for (unsigned int c = 0; c < dim; ++c)
        {
          std::array<Components, dim + 1> strain{}, stress{};
          for (unsigned int d = 0; d < dim; ++d)
            strain[d][voigt_index<dim>(c, d)] = 1.;
          if (mean_volume)
            for (unsigned int i = 0; i < 3; ++i)
              {
                strain[c][i] -= 1. / 3.;
                strain[dim][i] = 1. / 3.;
              }
          for (unsigned int k = 0; k <= dim; ++k)
            PointModuli::multiply(moduli.values, strain[k], stress[k]);
          for (unsigned int k = 0; k <= dim; ++k)
            for (unsigned int l = 0; l <= dim; ++l)
              forms[c][k][l] = std::inner_product(strain[k].begin(),
                                                  strain[k].end(),
                                                  stress[l].begin(),
                                                  0.);
        }
      return forms;
    }



    template <int dim>
    double
    energy(const EnergyForm<dim> &form,
           const Tensor<1, dim>  &gradient,
           const double           mean)
    {
      std::array<double, dim + 1> x;
      for (unsigned int d = 0; d < dim; ++d)
        x[d] = gradient[d];
      x[dim]     = mean;
      double sum = 0.;
      for (unsigned int k = 0; k <= dim; ++k)
        for (unsigned int l = 0; l <= dim; ++l)
          sum += x[k] * form[k][l] * x[l];
      return sum;
    }
  } // namespace



  template <int dim>
  template <int degree, typename PointModuli>
  void
  StiffnessOperator<dim>::add_cell_diagonals(
    const PointValues<PointModuli> &moduli)
  {
    const FESystem<dim>      &fe     = space.finite_element();
    const FiniteElement<dim> &scalar = fe.base_element(0);
    const QGauss<dim>         rule(degree + 1);
    const unsigned int        n_shapes = scalar.n_dofs_per_cell();
    const bool                mean_volume =
      space.volumetric_strain() == VolumetricStrain::mean;

    FEEvaluation<dim, degree, degree + 1, dim, double> evaluation(*loops);
    std::vector<Tensor<1, dim>>                        reference_gradients;
    for (unsigned int q = 0; q < rule.size(); ++q)
      for (unsigned int i = 0; i < n_shapes; ++i)
        reference_gradients.push_back(scalar.shape_grad(i, rule.point(q)));
    std::vector<Tensor<1, dim>>          gradients(rule.size() * n_shapes);
    std::vector<Tensor<1, dim>>          means(n_shapes);
    std::vector<double>                  entries(fe.n_dofs_per_cell());
    std::vector<types::global_dof_index> dofs(fe.n_dofs_per_cell());

    std::vector<unsigned int> place(dim * n_shapes);
    for (unsigned int i = 0; i < n_shapes; ++i)
      for (unsigned int c = 0; c < dim; ++c)
        place[i * dim + c] = fe.component_to_system_index(c, i);
    std::array<EnergyForm<dim>, dim> forms;
    if (moduli.is_uniform())
      forms = energy_forms<dim>(moduli[0], mean_volume);

    for (unsigned int batch = 0; batch < loops->n_cell_batches(); ++batch)
      {
        evaluation.reinit(batch);
        for (unsigned int lane = 0;
             lane < loops->n_active_entries_per_cell_batch(batch);
             ++lane)
          {
            double volume = 0.;
            std::fill(means.begin(), means.end(), Tensor<1, dim>());
            for (unsigned int q = 0; q < rule.size(); ++q)
              {
                Tensor<2, dim> to_real;
                const auto     of_lanes = evaluation.inverse_jacobian(q);
                for (unsigned int d = 0; d < dim; ++d)
                  for (unsigned int e = 0; e < dim; ++e)
                    to_real[d][e] = of_lanes[d][e][lane];
                const double weight = evaluation.JxW(q)[lane];
                volume += weight;
                for (unsigned int i = 0; i < n_shapes; ++i)
                  {
                    gradients[q * n_shapes + i] =
                      to_real * reference_gradients[q * n_shapes + i];
                    means[i] += weight * gradients[q * n_shapes + i];
                  }
              }
            for (Tensor<1, dim> &mean : means)
              mean /= volume;

            std::fill(entries.begin(), entries.end(), 0.);
            for (unsigned int q = 0; q < rule.size(); ++q)
              {
                if (!moduli.is_uniform())
                  forms =
                    energy_forms<dim>(moduli[first_points[batch][lane] + q],
                                      mean_volume);
                const double weight = evaluation.JxW(q)[lane];
                for (unsigned int i = 0; i < n_shapes; ++i)
                  for (unsigned int c = 0; c < dim; ++c)
                    entries[place[i * dim + c]] +=
                      weight * energy<dim>(forms[c],
                                           gradients[q * n_shapes + i],
                                           means[i][c]);
              }
            loops->get_cell_iterator(batch, lane)->get_dof_indices(dofs);
            for (unsigned int i = 0; i < dofs.size(); ++i)
              if (const auto *masters =
                    space.constraints().get_constraint_entries(dofs[i]))
                for (const auto &[master, factor] : *masters)
                  operator_diagonal(master) += factor * factor * entries[i];
              else
                operator_diagonal(dofs[i]) += entries[i];
          }
      }
  }



  template <int dim>
  void
  StiffnessOperator<dim>::compute_diagonal()
  {
    initialize_dof_vector(operator_diagonal);
    std::visit(
      [&](const auto &of_points) {
        if (space.finite_element().degree == 2)
          add_cell_diagonals<2>(of_points);
        else
          add_cell_diagonals<1>(of_points);
      },
      moduli);
    operator_diagonal.compress(VectorOperation::add);
    for (const unsigned int row : constrained_rows)
      operator_diagonal.local_element(row) = 1.;
  }



  template void
  StiffnessOperator<2>::compute_diagonal();
  template void
  StiffnessOperator<3>::compute_diagonal();
} // namespace Crevasse
