// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_time_instant_provider_h
#define crevasse_time_instant_provider_h

#include <crevasse/contact/contact_solver.h>
#include <crevasse/discretisation/algorithmic_moduli.h>

namespace Crevasse
{
  /** Material and contact solver for an evaluation at one instant. */
  template <int dim>
  struct Instant
  {
    const MaterialState<dim> &material;
    /** Contact solver for the stiffness without its factor k. */
    ContactSolver &contact_solver;
  };

  /** Data for an evaluation at one instant with implicit viscous strain. */
  template <int dim>
  struct ImplicitInstant
  {
    const MaterialState<dim>     &material;
    const AlgorithmicModuli<dim> &moduli;
    /** Contact solver for the sum of the moduli; null if only the material is
     * implicit. */
    ContactSolver *contact_solver;
  };

  /** Tangent of Newton's method for implicit nonlinear creep. */
  template <int dim>
  struct Tangent
  {
    /** Moduli CreepPoint::relaxed_stiffness() at some stress. */
    const PointValues<VoigtMatrix<dim>> *moduli;
    ContactSolver                       *contact_solver; ///< solver for moduli
  };

  /** Provides material, moduli and contact solver for any instant of the
   * period. They are valid until the next call. */
  template <int dim>
  class InstantProvider
  {
  public:
    virtual ~InstantProvider() = default;

    virtual Instant<dim>
    at(const double t) = 0;

    virtual const MaterialState<dim> &
    material_at(const double t) = 0;

    /** Data for an implicit r = r̂ + c ṙ. */
    virtual ImplicitInstant<dim>
    implicit_at(const double t, const double c) = 0;

    /** Data for r = r̂ + c ṙ without contact solver. */
    virtual ImplicitInstant<dim>
    implicit_material_at(const double t, const double c) = 0;

    /** Last tangent, or a new one by renew_tangent() if there is none. */
    virtual Tangent<dim>
    tangent_at(const double  t,
               const double  c,
               const Vector &stress,
               const Vector &known) = 0;

    /** Computes the tangent at a stress, for r = r̂ + c ṙ with known r̂. */
    virtual Tangent<dim>
    renew_tangent(const double  t,
                  const double  c,
                  const Vector &stress,
                  const Vector &known) = 0;

    /** Relaxation of the material at @p t over a time c. */
    virtual const RelaxationFunctions<dim> &
    relaxation_at(const double t, const double c) = 0;

    /** Counts and largest errors of all contact problems so far. */
    virtual SolverStatistics
    statistics() const = 0;
  };
} // namespace Crevasse

#endif
