// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_discretisation_external_loads_h
#define crevasse_discretisation_external_loads_h

#include <crevasse/base/expression.h>
#include <crevasse/discretisation/space.h>
#include <crevasse/parameters/parameters.h>

namespace Crevasse
{
  template <int dim>
  class StrainOperator;

  /** Non-zero components of forces in the volume. */
  std::vector<std::pair<unsigned int, Expression>>
  components_in_volume(const LoadParameters &parameters);

  /** Traction and pressure at a point of a loaded boundary, as a force per
   * area. @param normal outward. */
  template <int dim>
  dealii::Tensor<1, dim>
  surface_force(const LoadParameters            &parameters,
                const dealii::types::boundary_id id,
                const dealii::Point<dim>        &point,
                const dealii::Tensor<1, dim>    &normal,
                const double                     t);

  /**
   * Load vector ∫ φ₁·v + ∫_∂₃ φ₂·v as a function of time. Integrals are
   * computed once where possible: a component that depends on time alone is its
   * amplitude times a stored vector, and one that does not depend on time a
   * constant vector. Only a component of space and time is evaluated at
   * quadrature points, with stored weights, at each instant.
   */
  template <int dim>
  class ExternalLoads
  {
  public:
    /** Integrates the loads. @param space Must outlive this object. */
    ExternalLoads(const Space<dim>          &space,
                  const StrainOperator<dim> &strain_operator,
                  const LoadParameters      &parameters);

    /** Loads at @p t, 0 ≤ t < Period, within the period. Collective.
     * @throw SceneError if a formula has no finite value. */
    void
    evaluate(const double t, Vector &loads) const;

    /** Checks before a run that all formulas have values at the given instants.
     * Collective.
     * @throw SceneError with the point and the instant. */
    void
    validate_and_bound(const std::vector<double> &instants) const
    {
      Vector loads(constant);
      for (const double t : instants)
        evaluate(t, loads);
    }

    /** Mean over a period of the loads divided by a function of time, to
     * rounding: see period_mean(). Collective. */
    void
    mean(const std::function<double(const double t)> &divisor,
         const double                                 period,
         Vector                                      &mean) const;

  private:
    using Weights =
      std::vector<std::pair<dealii::types::global_dof_index, double>>;

    /** A component of a force where it acts. */
    struct Part
    {
      const LoadParameters::Force &force;
      const PlacedFormulas        &placed;
      unsigned int                 component;
    };

    /** Calls f(point, weights) for the points of this rank in the volume or on
     * the loaded boundaries of a part. */
    template <typename Function>
    static void
    for_each_loaded_point(const Space<dim> &space,
                          const Part       &part,
                          const Function   &f);

    /** Load f(t) times integrals of shape functions. */
    struct Amplitude
    {
      Expression factor;
      Vector     integrals;
    };

    /** A quadrature point, and unknowns with their weights. */
    struct WeightedPoint
    {
      dealii::Point<dim> point;
      Weights            weights;
    };

    /** Load f(x,t) at the points where it acts. */
    struct Density
    {
      Expression                 value;
      std::vector<WeightedPoint> points;
    };

    void
    add(const Part                &part,
        const Space<dim>          &space,
        const StrainOperator<dim> &strain_operator);

    /** Integrates the load vector with values f(formula, point) of formulas,
     * and the factor f(nullptr, point) of the constant part. Collective. */
    template <typename Function>
    void
    integrate(const Function &f, Vector &loads) const;

    const dealii::AffineConstraints<double> &constraints;

    std::vector<Amplitude> amplitudes;
    std::vector<Density>   densities;
    Vector                 constant;
  };
} // namespace Crevasse

#endif
