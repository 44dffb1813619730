// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_time_creep_stage_h
#define crevasse_time_creep_stage_h

#include <crevasse/discretisation/external_loads.h>
#include <crevasse/discretisation/strain_operator.h>
#include <crevasse/time/inelastic_strain.h>
#include <crevasse/time/instant_provider.h>
#include <crevasse/time/state.h>

#include <map>

namespace Crevasse
{
  /**
   * Stage r = r̂ + c ṙ of an implicit scheme with nonlinear creep. With the
   * stress s(e) of CreepPoint::relaxed_stress() at each point, the solution of
   *
   *     ∫ Dᵀ s(Dq − f − r̂) − loads = Lᵀ g,     0 ≤ g ⟂ Lq − gap ≥ 0
   *
   * minimises an incremental potential, convex without hardening.
   * Newton's method, semismooth in contact and stress, iterates on the
   * variational inequality with moduli C and the right-hand side
   *
   *     b(q) = loads + ∫ Dᵀ (kC Dq − s(Dq − f − r̂)),
   *
   * whose change is the residual of the solution. One factorised C serves many
   * steps and periods, with Anderson acceleration of b; if b converges slowly,
   * C is renewed. A step beyond the least potential along its direction is
   * shortened. If the iteration diverges, as for large n after a sudden load,
   * stages of smaller c provide starts (continuation).
   *
   * The start is the last displacement plus the increment between the same
   * instants of the previous period.
   */
  template <int dim>
  class CreepStage
  {
  public:
    /** All arguments must outlive this object.
     *
     * @param tolerance for the residual, relative to the largest nodal force
     * of the loads. */
    CreepStage(const StrainOperator<dim> &strain_operator,
               const ExternalLoads<dim>  &loads,
               InstantProvider<dim>      &instants,
               const double               tolerance);

    /**
     * Solves for displacement, stress and contact forces.
     *
     * @param t instant within the period.
     * @param base strain from which @p known counts, or null.
     * @param[in,out] state last state; on return the solution.
     * @param[out] right_hand_side b
     * @return the solver of the last variational inequality.
     * @throw NumericalError with the residual if Newton's method fails.
     */
    ContactSolver &
    solve(const double  t,
          const Vector &known,
          const Vector *base,
          const double  c,
          State        &state,
          Vector       &right_hand_side);

    /** Computes ṙ under a stress.
     *
     * @param known r, or r̂ in r = r̂ + c ṙ.
     * @return the largest relaxation rate at this rank's points. */
    static double
    rates(const InelasticStrain<dim> &known,
          const double                c,
          const Vector               &stress,
          Vector                     &rate);

    /** Serialises the displacements from which the next stages start. */
    void
    serialize(StateArchive &archive);

  private:
    /** Data of the current stage. */
    struct Stage
    {
      const double               t, c, log_kappa;
      const InelasticStrain<dim> known;
      Tangent<dim>               tangent;
      State                     &state;
    };

    struct Visit;

    /** Visit at an instant up to rounding, or null. */
    Visit *
    visit_at(const double t);

    /** Adds the last period's increment from the last stage to @p t. */
    void
    predict(const double t, Vector &displacement);

    /** Stores the displacement for the next period. */
    void
    keep(const double t, const Vector &displacement);

    /** Computes the stress of the displacement, and b. */
    void
    evaluate(Stage &stage, Vector &right_hand_side);

    /** Newton's method from the displacement of the stage.
     *
     * @param enough sufficient residual, relative to the largest nodal force.
     * @throw NumericalError with the residual if the iteration fails. */
    ContactSolver &
    iterate(Stage &stage, const double enough, Vector &right_hand_side);

    /** Shortens the last Newton step to about the least potential along it, if
     * the potential first decreases. */
    void
    cut_step(Stage &stage);

    const StrainOperator<dim> &strain_operator;
    const ExternalLoads<dim>  &loads;
    InstantProvider<dim>      &instants;
    const double               tolerance;

    Vector forces; ///< nodal forces of the loads
    Vector excess; ///< kC Dq − s at points
    Vector next;   ///< b of the last displacement
    Vector before; ///< displacement before the last Newton step

    /** Displacement of a stage in this period or the last one. */
    struct Visit
    {
      Vector       displacement;
      unsigned int period = 0; ///< period number, from the first stage
    };

    std::map<double, Visit> path; ///< visits by instant
    Vector                  last; ///< last period's value at last_t, or empty
    double                  last_t = 0.; ///< instant of the last stage
    unsigned int            period = 0;
  };
} // namespace Crevasse

#endif
