// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/collectively.h>
#include <crevasse/base/period_mean.h>
#include <crevasse/discretisation/cell_values.h>
#include <crevasse/discretisation/external_loads.h>
#include <crevasse/discretisation/strain_operator.h>

namespace Crevasse
{
  std::vector<std::pair<unsigned int, Expression>>
  components_in_volume(const LoadParameters &parameters)
  {
    std::vector<std::pair<unsigned int, Expression>> components;
    for (const LoadParameters::Force &force : parameters.forces())
      for (unsigned int d = 0; force.in_volume && d < force.components->size();
           ++d)
        if (Expression value((*force.components)[d]); !value.is_zero())
          components.emplace_back(d, std::move(value));
    return components;
  }



  template <int dim>
  ExternalLoads<dim>::ExternalLoads(const Space<dim>          &space,
                                    const StrainOperator<dim> &strain_operator,
                                    const LoadParameters      &parameters)
    : constraints(space.constraints)
  {
    strain_operator.initialize(constant);
    for (const LoadParameters::Force &force : parameters.forces())
      for (unsigned int d = 0; d < force.components->size(); ++d)
        add(Expression((*force.components)[d]),
            d,
            force.in_volume,
            space,
            strain_operator);
    constant.compress(dealii::VectorOperation::add);
  }



  template <int dim>
  void
  ExternalLoads<dim>::evaluate(const double t, Vector &loads) const
  {
    integrate(
      [t](const Expression *formula, const dealii::Point<dim> &point) {
        return formula != nullptr ? formula->value(point, t) : 1.;
      },
      loads);
  }



  template <int dim>
  void
  ExternalLoads<dim>::mean(const std::function<double(const double t)> &divisor,
                           const double                                 period,
                           Vector &mean) const
  {
    integrate(
      [&](const Expression *formula, const dealii::Point<dim> &point) {
        return period_mean(
          [&](const double t) {
            return (formula != nullptr ? formula->value(point, t) : 1.) /
                   divisor(t);
          },
          period,
          formula != nullptr ? formula->kinks_in_time() : std::set<double>());
      },
      mean);
  }



  template <int dim>
  template <typename Function>
  void
  ExternalLoads<dim>::for_each_loaded_point(const Space<dim>  &space,
                                            const unsigned int component,
                                            const bool         in_volume,
                                            const Function    &f)
  {
    const dealii::UpdateFlags flags = dealii::update_values |
                                      dealii::update_JxW_values |
                                      dealii::update_quadrature_points;
    CellValues<dim>                                  cell_values(space, flags);
    dealii::FEFaceValues<dim>                        face_values(space.mapping,
                                          space.finite_element,
                                          space.face_quadrature(),
                                          flags);
    std::vector<dealii::types::global_dof_index>     unknowns;
    std::vector<std::vector<dealii::Tensor<1, dim>>> singular_values;
    const auto visit = [&](const auto                      &cell,
                           const dealii::FEValuesBase<dim> &values) {
      const dealii::FiniteElement<dim> &fe = values.get_fe();
      const unsigned int                n  = fe.n_dofs_per_cell();
      space.get_unknowns(cell, unknowns);
      if constexpr (dim == 2)
        if (const SingularShapes *shapes = space.singular_shapes())
          shapes->values(values, singular_values);
      for (const unsigned int q : values.quadrature_point_indices())
        {
          Weights weights;
          for (unsigned int i = 0; i < unknowns.size(); ++i)
            {
              double shape = 0.;
              if (i >= n)
                shape = singular_values[i - n][q][component];
              else if (fe.system_to_component_index(i).first == component)
                shape = values.shape_value(i, q);
              if (shape != 0.)
                weights.emplace_back(unknowns[i], shape * values.JxW(q));
            }
          f(values.quadrature_point(q), std::move(weights));
        }
    };
    for (const auto &cell : owned_cells(space.dof_handler))
      if (in_volume)
        visit(cell, cell_values.reinit(cell));
      else
        for (const unsigned int face : cell->face_indices())
          if (cell->at_boundary(face) &&
              space.roles.loaded.count(cell->face(face)->boundary_id()) > 0)
            {
              face_values.reinit(cell, face);
              visit(cell, face_values);
            }
  }



  template <int dim>
  void
  ExternalLoads<dim>::add(Expression               &&component_value,
                          const unsigned int         component,
                          const bool                 in_volume,
                          const Space<dim>          &space,
                          const StrainOperator<dim> &strain_operator)
  {
    if (component_value.is_zero())
      return;
    const auto for_each_point = [&](const auto &f) {
      for_each_loaded_point(space, component, in_volume, f);
    };
    if (!component_value.depends_on_time())
      // Only one rank may find a formula without a value at a point.
      collectively(space.communicator(), [&]() {
        for_each_point([&](const dealii::Point<dim> &point, Weights &&weights) {
          const double value = component_value.value(point);
          for (const auto &[dof, weight] : weights)
            constraints.distribute_local_to_global(dof,
                                                   value * weight,
                                                   constant);
        });
      });
    else if (!component_value.depends_on_space())
      {
        Vector integrals;
        strain_operator.initialize(integrals);
        for_each_point([&](const dealii::Point<dim> &, Weights &&weights) {
          for (const auto &[dof, weight] : weights)
            constraints.distribute_local_to_global(dof, weight, integrals);
        });
        integrals.compress(dealii::VectorOperation::add);
        amplitudes.push_back({std::move(component_value), integrals});
      }
    else
      {
        std::vector<WeightedPoint> points;
        for_each_point([&](const dealii::Point<dim> &point, Weights &&weights) {
          points.push_back({point, std::move(weights)});
        });
        densities.push_back({std::move(component_value), std::move(points)});
      }
  }



  template <int dim>
  template <typename Function>
  void
  ExternalLoads<dim>::integrate(const Function &f, Vector &loads) const
  {
    loads = 0.;
    if (!densities.empty())
      {
        collectively(loads.get_mpi_communicator(), [&]() {
          for (const Density &density : densities)
            for (const WeightedPoint &weighted : density.points)
              {
                const double value = f(&density.value, weighted.point);
                for (const auto &[dof, weight] : weighted.weights)
                  constraints.distribute_local_to_global(dof,
                                                         value * weight,
                                                         loads);
              }
        });
        loads.compress(dealii::VectorOperation::add);
      }
    loads.add(f(nullptr, dealii::Point<dim>()), constant);
    for (const Amplitude &amplitude : amplitudes)
      loads.add(f(&amplitude.factor, dealii::Point<dim>()),
                amplitude.integrals);
  }



  template class ExternalLoads<2>;
  template class ExternalLoads<3>;
} // namespace Crevasse
