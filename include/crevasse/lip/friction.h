// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_lip_friction_h
#define crevasse_lip_friction_h

#include <crevasse/lip/contact_boundary.h>
#include <crevasse/temperature/temperature.h>

namespace Crevasse
{
  /** Coulomb's friction on the lips: the coefficient of each contact node at an
   * instant, and its jumps along the tangents. */
  template <int dim>
  class Friction
  {
  public:
    /** References must outlive this object.
     * @param coefficient μ, a formula of point, instant and temperature. */
    Friction(const ContactBoundary<dim> &lip,
             const Temperature<dim>     &temperature,
             const Expression           &coefficient);

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
    const ContactBoundary<dim> &lip;
    const Temperature<dim>     &temperature;
    const Expression            coefficient;
    const bool                  varies; ///< whether it depends on time
  };
} // namespace Crevasse

#endif
