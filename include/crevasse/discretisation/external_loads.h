// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_discretisation_external_loads_h
#define crevasse_discretisation_external_loads_h

#include <crevasse/base/expression.h>
#include <crevasse/discretisation/space.h>
#include <crevasse/discretisation/strain_operator.h>
#include <crevasse/parameters/parameters.h>

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
    validate_and_bound(const std::vector<double> &instants,
                       const MPI_Comm             communicator) const;

    /** The mean of the loads divided by a function of time over a period,
     * to rounding: see period_mean(). Collective. */
    void
    mean(const Expression &divisor, const double period, Vector &mean) const;

  private:
    /** f(t) times the integrals of the shape functions. */
    struct Amplitude
    {
      Expression factor;
      Vector     integrals;
    };

    /** A quadrature point and the entries of the load vector it feeds. */
    struct WeightedPoint
    {
      dealii::Point<dim>                                              point;
      std::vector<std::pair<dealii::types::global_dof_index, double>> weights;
    };

    /** f(x,t) at the points of its support. */
    struct Density
    {
      Expression                 value;
      std::vector<WeightedPoint> points;
    };

    /** Whether a component of the load acts on a boundary or in the volume. */
    enum class Support
    {
      volume,
      loaded_boundary
    };

    void
    add(Expression               &&component_value,
        const unsigned int         component,
        const Support              support,
        const Space<dim>          &space,
        const StrainOperator<dim> &strain_operator);

    void
    add_densities(const double t, Vector &loads) const;

    std::vector<Amplitude> amplitudes;
    std::vector<Density>   densities;
    Vector                 constant;
  };
} // namespace Crevasse

#endif
