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
      for (unsigned int i = 0; force.in_volume && i < force.values->size(); ++i)
        for (unsigned int d = 0; d < (*force.values)[i].components.size(); ++d)
          if (const auto &value = (*force.values)[i].components[d];
              !value.is_zero())
            components.emplace_back(d, value);
    return components;
  }



  template <int dim>
  dealii::Tensor<1, dim>
  surface_force(const LoadParameters            &parameters,
                const dealii::types::boundary_id id,
                const dealii::Point<dim>        &point,
                const dealii::Tensor<1, dim>    &normal,
                const double                     t)
  {
    dealii::Tensor<1, dim> sum;
    for (const LoadParameters::Force &force : parameters.forces())
      if (!force.in_volume)
        for (const PlacedFormulas &placed : *force.values)
          if (placed.act_on(id))
            for (unsigned int d = 0; d < placed.components.size(); ++d)
              {
                const double value = placed.components[d].value(point, t);
                if (force.along_normal)
                  sum -= value * normal;
                else
                  sum[d] += value;
              }
    return sum;
  }



  template <int dim>
  ExternalLoads<dim>::ExternalLoads(const Space<dim>          &space,
                                    const StrainOperator<dim> &strain_operator,
                                    const LoadParameters      &parameters)
    : constraints(space.constraints)
  {
    strain_operator.initialize(constant);
    for (const LoadParameters::Force &force : parameters.forces())
      for (const PlacedFormulas &placed : *force.values)
        for (unsigned int d = 0; d < placed.components.size(); ++d)
          add({force, placed, d}, space, strain_operator);
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
  ExternalLoads<dim>::for_each_loaded_point(const Space<dim> &space,
                                            const Part       &part,
                                            const Function   &f)
  {
    const dealii::UpdateFlags flags = dealii::update_values |
                                      dealii::update_JxW_values |
                                      dealii::update_quadrature_points;
    CellValues<dim>                                  cell_values(space, flags);
    dealii::FEFaceValues<dim>                        face_values(space.mapping,
                                          space.finite_element,
                                          space.face_quadrature(),
                                          flags |
                                            dealii::update_normal_vectors);
    std::vector<dealii::types::global_dof_index>     unknowns;
    std::vector<std::vector<dealii::Tensor<1, dim>>> singular_values;
    const auto visit = [&](const auto                      &cell,
                           const dealii::FEValuesBase<dim> &values,
                           const bool                       along_normal) {
      const dealii::FiniteElement<dim> &fe = values.get_fe();
      const unsigned int                n  = fe.n_dofs_per_cell();
      space.get_unknowns(cell, unknowns);
      if constexpr (dim == 2)
        if (const SingularShapes *shapes = space.singular_shapes())
          shapes->values(values, singular_values);
      for (const unsigned int q : values.quadrature_point_indices())
        {
          dealii::Tensor<1, dim> direction;
          if (along_normal)
            direction = -values.normal_vector(q);
          else
            direction[part.component] = 1.;
          Weights weights;
          for (unsigned int i = 0; i < unknowns.size(); ++i)
            {
              const double shape =
                i >= n ? singular_values[i - n][q] * direction
                       : values.shape_value(i, q) *
                           direction[fe.system_to_component_index(i).first];
              if (shape != 0.)
                weights.emplace_back(unknowns[i], shape * values.JxW(q));
            }
          f(values.quadrature_point(q), std::move(weights));
        }
    };
    for (const auto &cell : owned_cells(space.dof_handler))
      if (part.force.in_volume)
        visit(cell, cell_values.reinit(cell), false);
      else
        for (const unsigned int face : cell->face_indices())
          if (const auto id = cell->face(face)->boundary_id();
              cell->at_boundary(face) && space.roles.loaded.count(id) > 0 &&
              part.placed.act_on(id))
            {
              const auto visit_face = [&](dealii::FEFaceValues<dim> &values) {
                values.reinit(cell, face);
                visit(cell, values, part.force.along_normal);
              };
              if constexpr (dim == 2)
                if (const SingularShapes *shapes = space.singular_shapes())
                  if (const auto rule = shapes->rule_from_tip(cell->face(face)))
                    {
                      dealii::FEFaceValues<2> at_tip(
                        space.mapping,
                        space.finite_element,
                        *rule,
                        face_values.get_update_flags());
                      visit_face(at_tip);
                      continue;
                    }
              visit_face(face_values);
            }
  }



  template <int dim>
  void
  ExternalLoads<dim>::add(const Part                &part,
                          const Space<dim>          &space,
                          const StrainOperator<dim> &strain_operator)
  {
    const Expression component_value = part.placed.components[part.component];
    if (component_value.is_zero())
      return;
    const auto for_each_point = [&](const auto &f) {
      for_each_loaded_point(space, part, f);
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
        amplitudes.push_back({component_value, integrals});
      }
    else
      {
        std::vector<WeightedPoint> points;
        for_each_point([&](const dealii::Point<dim> &point, Weights &&weights) {
          points.push_back({point, std::move(weights)});
        });
        densities.push_back({component_value, std::move(points)});
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



  template decltype(surface_force<2>) surface_force<2>;
  template decltype(surface_force<3>) surface_force<3>;

  template class ExternalLoads<2>;
  template class ExternalLoads<3>;
} // namespace Crevasse
