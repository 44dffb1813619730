// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_lip_friction_h
#define crevasse_lip_friction_h

#include <crevasse/lip/contact_boundary.h>
#include <crevasse/parameters/load_parameters.h>
#include <crevasse/temperature/temperature.h>

namespace Crevasse
{
  /** Coulomb's friction on the lips: the coefficient of each contact node at an
   * instant, and its jumps along the tangents. */
  template <int dim>
  class Friction
  {
  public:
    /** Collective. References must outlive this object.
     * @param coefficients μ, formulas of point, instant and temperature by
     * boundary: where boundaries meet, the first one has the node, and where
     * none acts, μ is 0.
     * @throw SceneError as evaluate(), if they do not depend on time. */
    Friction(const ContactBoundary<dim>    &lip,
             const dealii::DoFHandler<dim> &dof_handler,
             const Temperature<dim>        &temperature,
             const LoadFormulas            &coefficients);

    /** Sets the coefficients of an instant. Collective.
     * @throw SceneError with point and instant if one is negative. */
    void
    evaluate(const double t, FrictionState &state) const;

    /** Makes the jumps of a displacement those where the next increment begins.
     */
    void
    commit(const Vector &displacement, FrictionState &state) const;

    /** A state at rest. */
    FrictionState
    at_rest() const;

  private:
    /** Coefficient of a contact node. @throw SceneError if it is negative. */
    double
    coefficient(const unsigned int node, const double t) const;

    /** Sets the coefficients of all contact nodes. Collective. */
    void
    set(const double t, std::vector<double> &coefficients) const;

    const ContactBoundary<dim> &lip;
    const Temperature<dim>     &temperature;

    std::vector<Expression>   formulas;       ///< the first: 0
    std::vector<unsigned int> formula;        ///< number of each contact node's
    bool                      varies = false; ///< whether any depends on time
    std::vector<double>       constant;       ///< coefficients if none varies
  };
} // namespace Crevasse

#endif
