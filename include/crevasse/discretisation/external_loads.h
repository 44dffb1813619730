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

  /** The components of forces in the volume that are not zero. */
  std::vector<std::pair<unsigned int, Expression>>
  components_in_volume(const LoadParameters &parameters);

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
                  const LoadParameters      &parameters);

    /** Collective. @param t instant within the period, 0 ≤ t < Period.
     * @throw SceneError if a formula has no finite value. */
    void
    evaluate(const double t, Vector &loads) const;

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
    mean(const std::function<double(const double t)> &divisor,
         const double                                 period,
         Vector                                      &mean) const;

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
                          const Function    &f);

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
        const StrainOperator<dim> &strain_operator);

    /** The load vector whose formulas have the values f(formula, point), and
     * what is constant f(nullptr, point). Collective. */
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
