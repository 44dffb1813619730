// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_time_instant_provider_h
#define crevasse_time_instant_provider_h

#include <crevasse/contact/contact_solver.h>
#include <crevasse/discretisation/algorithmic_moduli.h>

namespace Crevasse
{
  /** What an evaluation at one instant works with. */
  template <int dim>
  struct Instant
  {
    const MaterialState<dim> &material;
    /** Of the stiffness without its factor k. */
    ContactSolver &contact_solver;
  };

  /** The same where the viscous strain is implicit. */
  template <int dim>
  struct ImplicitInstant
  {
    const MaterialState<dim>     &material;
    const AlgorithmicModuli<dim> &moduli;
    /** Of the sum of these moduli; null if only the material is implicit. */
    ContactSolver *contact_solver;
  };

  /** What Newton's method works with where nonlinear creep is implicit. */
  template <int dim>
  struct Tangent
  {
    /** ds/de without its factor k: that of some stress, see
     * CreepPoint::relaxed_stiffness(). */
    const PointValues<VoigtMatrix<dim>> *moduli;
    ContactSolver                       *contact_solver; ///< of these moduli
  };

  /** Provides these for any instant of the period. They last until the next
   * call. */
  template <int dim>
  class InstantProvider
  {
  public:
    virtual ~InstantProvider() = default;

    virtual Instant<dim>
    at(const double t) = 0;

    virtual const MaterialState<dim> &
    material_at(const double t) = 0;

    /** For r = r̂ + c ṙ. */
    virtual ImplicitInstant<dim>
    implicit_at(const double t, const double c) = 0;

    /** The same without contact solver. */
    virtual ImplicitInstant<dim>
    implicit_material_at(const double t, const double c) = 0;

    /** The tangent that was made last, by renew_tangent() with these arguments
     * if there is none. */
    virtual Tangent<dim>
    tangent_at(const double  t,
               const double  c,
               const Vector &stress,
               const Vector &known) = 0;

    /** Makes the moduli of this stress, for r = r̂ + c ṙ of a known r̂. */
    virtual Tangent<dim>
    renew_tangent(const double  t,
                  const double  c,
                  const Vector &stress,
                  const Vector &known) = 0;

    /** How the material relaxes over a time c, as at @p t. */
    virtual const RelaxationFunctions<dim> &
    relaxation_at(const double t, const double c) = 0;

    /** Counts and largest errors of all contact problems so far. */
    virtual SolverStatistics
    statistics() const = 0;
  };
} // namespace Crevasse

#endif
