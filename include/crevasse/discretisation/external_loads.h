// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_discretisation_external_loads_h
#define crevasse_discretisation_external_loads_h

#include <crevasse/base/collectively.h>
#include <crevasse/base/expression.h>
#include <crevasse/base/period_mean.h>
#include <crevasse/discretisation/cell_values.h>
#include <crevasse/discretisation/space.h>
#include <crevasse/discretisation/strain_operator.h>
#include <crevasse/parameters/parameters.h>

#include <deal.II/fe/fe_values.h>

#include <vector>

namespace Crevasse
{
  /**
   * The load vector ∫ φ₁·v + ∫_∂₃ φ₂·v as a function of time. What can be
   * integrated once is: a component that is a function of time alone becomes
   * its amplitude times a stored vector, one that does not depend on time a
   * constant vector. Only a component that mixes space and time is evaluated
   * at its quadrature points at each instant, whose weights are stored.
   */
  template <int dim>
  class ExternalLoads
  {
  public:
    /** @param space must outlive this object. */
    ExternalLoads(const Space<dim>          &space,
                  const StrainOperator<dim> &strain_operator,
                  const LoadParameters      &parameters)
      : constraints(space.constraints())
    {
      strain_operator.initialize(constant);
      std::vector<Expression> traction   = *parameters.traction;
      std::vector<Expression> body_force = *parameters.body_force;
      for (unsigned int d = 0; d < traction.size(); ++d)
        add(std::move(traction[d]), d, false, space, strain_operator);
      for (unsigned int d = 0; d < body_force.size(); ++d)
        add(std::move(body_force[d]), d, true, space, strain_operator);
      constant.compress(dealii::VectorOperation::add);
    }

    /** Collective. @param t instant within the period, 0 ≤ t < Period.
     * @throw SceneError if a formula has no finite value. */
    void
    evaluate(const double t, Vector &loads) const
    {
      integrate(
        [t](const Expression *formula, const dealii::Point<dim> &point) {
          return formula != nullptr ? formula->value(point, t) : 1.;
        },
        loads);
    }

    /** Looks whether all formulas have a value at the given instants, so that
     * a run does not find out. Collective.
     * @throw SceneError with the point and the instant. */
    void
    validate_and_bound(const std::vector<double> &instants) const
    {
      Vector loads(constant);
      for (const double t : instants)
        evaluate(t, loads);
    }

    /** The mean of the loads divided by a function of time over a period,
     * to rounding: see period_mean(). Collective. */
    void
    mean(const Expression &divisor, const double period, Vector &mean) const
    {
      integrate(
        [&](const Expression *formula, const dealii::Point<dim> &point) {
          return period_mean(
            [&](const double t) {
              return (formula != nullptr ? formula->value(point, t) : 1.) /
                     divisor.value(dealii::Point<dim>(), t);
            },
            period);
        },
        mean);
    }

  private:
    using Weights =
      std::vector<std::pair<dealii::types::global_dof_index, double>>;

    /** Calls f(point, weights) for the points of this rank in the volume or on
     * the loaded boundary. */
    template <typename Function>
    static void
    for_each_loaded_point(const Space<dim>  &space,
                          const unsigned int component,
                          const bool         in_volume,
                          const Function    &f)
    {
      const dealii::UpdateFlags flags = dealii::update_values |
                                        dealii::update_JxW_values |
                                        dealii::update_quadrature_points;
      CellValues<dim>                              cell_values(space, flags);
      dealii::FEFaceValues<dim>                    face_values(space.mapping(),
                                            space.finite_element(),
                                            space.face_quadrature(),
                                            flags);
      std::vector<dealii::types::global_dof_index> unknowns;
      std::vector<std::vector<dealii::Tensor<1, dim>>> singular_values;
      const auto visit = [&](const auto                      &cell,
                             const dealii::FEValuesBase<dim> &values) {
        const dealii::FiniteElement<dim> &fe = values.get_fe();
        const unsigned int                n  = fe.n_dofs_per_cell();
        space.get_unknowns(cell, unknowns);
        if constexpr (dim == 2)
          if (const SingularShapes *shapes = space.singular_shapes())
            {
              singular_values.resize(shapes->size());
              for (unsigned int k = 0; k < shapes->size(); ++k)
                shapes->values(k, values, singular_values[k]);
            }
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
      for (const auto &cell : owned_cells(space.dof_handler()))
        if (in_volume)
          visit(cell, cell_values.reinit(cell));
        else
          for (const unsigned int face : cell->face_indices())
            if (cell->at_boundary(face) &&
                space.roles().loaded.count(cell->face(face)->boundary_id()) > 0)
              {
                face_values.reinit(cell, face);
                visit(cell, face_values);
              }
    }

    /** f(t) times the integrals of the shape functions. */
    struct Amplitude
    {
      Expression factor;
      Vector     integrals;
    };

    /** A quadrature point and the unknowns that it feeds. */
    struct WeightedPoint
    {
      dealii::Point<dim> point;
      Weights            weights;
    };

    /** f(x,t) at the points of its support. */
    struct Density
    {
      Expression                 value;
      std::vector<WeightedPoint> points;
    };

    /** Adds a component that acts in the volume or on the loaded boundary. */
    void
    add(Expression               &&component_value,
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
        // A formula without a value somewhere is known to one rank only.
        collectively(space.communicator(), [&]() {
          for_each_point(
            [&](const dealii::Point<dim> &point, Weights &&weights) {
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
          for_each_point(
            [&](const dealii::Point<dim> &point, Weights &&weights) {
              points.push_back({point, std::move(weights)});
            });
          densities.push_back({std::move(component_value), std::move(points)});
        }
    }

    /** The load vector whose formulas have the values f(formula, point), and
     * what is constant f(nullptr, point). Collective. */
    template <typename Function>
    void
    integrate(const Function &f, Vector &loads) const
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

    const dealii::AffineConstraints<double> &constraints;

    std::vector<Amplitude> amplitudes;
    std::vector<Density>   densities;
    Vector                 constant;
  };
} // namespace Crevasse

#endif
