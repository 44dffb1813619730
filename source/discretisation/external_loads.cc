// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/collectively.h>
#include <crevasse/base/period_mean.h>
#include <crevasse/base/text.h>
#include <crevasse/discretisation/cell_values.h>
#include <crevasse/discretisation/external_loads.h>

#include <deal.II/fe/fe_values.h>

#include <functional>

namespace Crevasse
{
  using namespace dealii;

  namespace
  {
    using Weights = std::vector<std::pair<types::global_dof_index, double>>;

    /** What the points of a cell or face contribute to the load vector for a
     * unit density of one component, with constraints resolved. */
    template <int dim>
    class PointWeights
    {
    public:
      explicit PointWeights(const Space<dim> &space)
        : space(space)
      {
      }



      void
      reinit(const FEValuesBase<dim>                              &values,
             const typename DoFHandler<dim>::active_cell_iterator &cell)
      {
        this->values = &values;
        space.get_unknowns(cell, indices);
        if constexpr (dim == 2)
          if (const SingularShapes *shapes = space.singular_shapes())
            {
              singular_values.resize(shapes->size());
              for (unsigned int k = 0; k < shapes->size(); ++k)
                shapes->values(k, values, singular_values[k]);
            }
      }



      Weights
      at(const unsigned int q, const unsigned int component) const
      {
        const FiniteElement<dim> &fe = values->get_fe();
        Weights                   weights;
        for (unsigned int i = 0; i < fe.n_dofs_per_cell(); ++i)
          if (fe.system_to_component_index(i).first == component)
            add(indices[i],
                values->shape_value(i, q) * values->JxW(q),
                weights);
        for (unsigned int k = 0; k < singular_values.size(); ++k)
          add(space.singular_unknown(k),
              singular_values[k][q][component] * values->JxW(q),
              weights);
        return weights;
      }

    private:
      void
      add(const types::global_dof_index unknown,
          const double                  weight,
          Weights                      &weights) const
      {
        if (weight == 0.)
          return;
        if (!space.constraints().is_constrained(unknown))
          weights.emplace_back(unknown, weight);
        else if (const auto *entries =
                   space.constraints().get_constraint_entries(unknown))
          for (const auto &[dof, factor] : *entries)
            weights.emplace_back(dof, factor * weight);
      }

      const Space<dim>                        &space;
      const FEValuesBase<dim>                 *values = nullptr;
      std::vector<types::global_dof_index>     indices;
      std::vector<std::vector<Tensor<1, dim>>> singular_values;
    };



    template <int dim>
    using PointFunction = std::function<void(const Point<dim> &, Weights &&)>;

    template <int dim>
    void
    for_each_volume_point(const Space<dim>         &space,
                          const unsigned int        component,
                          const PointFunction<dim> &f)
    {
      CellValues<dim>   cell_values(space,
                                  update_values | update_JxW_values |
                                    update_quadrature_points);
      PointWeights<dim> weights(space);
      for (const auto &cell : space.dof_handler().active_cell_iterators())
        if (cell->is_locally_owned())
          {
            const FEValues<dim> &values = cell_values.reinit(cell);
            weights.reinit(values, cell);
            for (const unsigned int q : values.quadrature_point_indices())
              f(values.quadrature_point(q), weights.at(q, component));
          }
    }



    template <int dim>
    void
    for_each_loaded_point(const Space<dim>         &space,
                          const unsigned int        component,
                          const PointFunction<dim> &f)
    {
      FEFaceValues<dim> values(space.mapping(),
                               space.finite_element(),
                               space.face_quadrature(),
                               update_values | update_JxW_values |
                                 update_quadrature_points);
      PointWeights<dim> weights(space);
      for (const auto &cell : space.dof_handler().active_cell_iterators())
        if (cell->is_locally_owned())
          for (const unsigned int face : cell->face_indices())
            if (cell->at_boundary(face) &&
                space.roles().loaded.count(cell->face(face)->boundary_id()) > 0)
              {
                values.reinit(cell, face);
                weights.reinit(values, cell);
                for (const unsigned int q : values.quadrature_point_indices())
                  f(values.quadrature_point(q), weights.at(q, component));
              }
    }
  } // namespace



  template <int dim>
  ExternalLoads<dim>::ExternalLoads(const Space<dim>          &space,
                                    const StrainOperator<dim> &strain_operator,
                                    const LoadParameters      &parameters)
  {
    strain_operator.initialize(constant);
    std::vector<Expression> traction   = *parameters.traction;
    std::vector<Expression> body_force = *parameters.body_force;
    for (unsigned int d = 0; d < traction.size(); ++d)
      add(std::move(traction[d]),
          d,
          Support::loaded_boundary,
          space,
          strain_operator);
    for (unsigned int d = 0; d < body_force.size(); ++d)
      add(std::move(body_force[d]), d, Support::volume, space, strain_operator);
    constant.compress(VectorOperation::add);
  }



  template <int dim>
  void
  ExternalLoads<dim>::add(Expression               &&component_value,
                          const unsigned int         component,
                          const Support              support,
                          const Space<dim>          &space,
                          const StrainOperator<dim> &strain_operator)
  {
    if (component_value.is_zero())
      return;
    const auto for_each_point = [&](const PointFunction<dim> &f) {
      if (support == Support::volume)
        for_each_volume_point<dim>(space, component, f);
      else
        for_each_loaded_point<dim>(space, component, f);
    };

    if (!component_value.depends_on_time())
      // A formula without a value somewhere is known to one rank only.
      collectively(space.communicator(), [&]() {
        for_each_point([&](const Point<dim> &point, Weights &&weights) {
          const double value = component_value.value(point);
          for (const auto &[dof, weight] : weights)
            constant(dof) += value * weight;
        });
      });
    else if (!component_value.depends_on_space())
      {
        Vector integrals;
        strain_operator.initialize(integrals);
        for_each_point([&](const Point<dim> &, Weights &&weights) {
          for (const auto &[dof, weight] : weights)
            integrals(dof) += weight;
        });
        integrals.compress(VectorOperation::add);
        amplitudes.push_back({std::move(component_value), integrals});
      }
    else
      {
        std::vector<WeightedPoint> points;
        for_each_point([&](const Point<dim> &point, Weights &&weights) {
          points.push_back({point, std::move(weights)});
        });
        densities.push_back({std::move(component_value), std::move(points)});
      }
  }



  template <int dim>
  void
  ExternalLoads<dim>::evaluate(const double t, Vector &loads) const
  {
    loads = 0.;
    if (!densities.empty())
      {
        collectively(loads.get_mpi_communicator(),
                     [&]() { add_densities(t, loads); });
        loads.compress(VectorOperation::add);
      }
    loads += constant;
    for (const Amplitude &amplitude : amplitudes)
      loads.add(amplitude.factor.value(Point<dim>(), t), amplitude.integrals);
  }



  template <int dim>
  void
  ExternalLoads<dim>::validate_and_bound(const std::vector<double> &instants,
                                         const MPI_Comm communicator) const
  {
    collectively(communicator, [&]() {
      for (const double t : instants)
        {
          for (const Amplitude &amplitude : amplitudes)
            amplitude.factor.value(Point<dim>(), t);
          for (const Density &density : densities)
            for (const WeightedPoint &weighted : density.points)
              density.value.value(weighted.point, t);
        }
    });
  }



  template <int dim>
  void
  ExternalLoads<dim>::mean(const Expression &divisor,
                           const double      period,
                           Vector           &mean) const
  {
    const auto mean_of = [&](const Expression *factor,
                             const Point<dim> &point) {
      return period_mean(
        [&](const double t) {
          return (factor != nullptr ? factor->value(point, t) : 1.) /
                 divisor.value(Point<dim>(), t);
        },
        period);
    };
    mean = 0.;
    if (!densities.empty())
      {
        collectively(mean.get_mpi_communicator(), [&]() {
          for (const Density &density : densities)
            for (const WeightedPoint &weighted : density.points)
              {
                const double value = mean_of(&density.value, weighted.point);
                for (const auto &[dof, weight] : weighted.weights)
                  mean(dof) += value * weight;
              }
        });
        mean.compress(VectorOperation::add);
      }
    mean.add(mean_of(nullptr, Point<dim>()), constant);
    for (const Amplitude &amplitude : amplitudes)
      mean.add(mean_of(&amplitude.factor, Point<dim>()), amplitude.integrals);
  }



  template <int dim>
  void
  ExternalLoads<dim>::add_densities(const double t, Vector &loads) const
  {
    for (const Density &density : densities)
      for (const WeightedPoint &weighted : density.points)
        {
          const double value = density.value.value(weighted.point, t);
          for (const auto &[dof, weight] : weighted.weights)
            loads(dof) += value * weight;
        }
  }



  template class ExternalLoads<2>;
  template class ExternalLoads<3>;
} // namespace Crevasse
