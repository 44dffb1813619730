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
   * The stage r = r̂ + c ṙ of an implicit scheme where creep is not linear. With
   * the stress s(e) of CreepPoint::relaxed_stress() at each point the body has
   * an incremental potential, which is convex without hardening, and
   *
   *     ∫ Dᵀ s(Dq − f − r̂) − loads = Lᵀ g,     0 ≤ g ⟂ Lq − gap ≥ 0.
   *
   * Newton's method, semismooth in contact and stress at once, solves the
   * variational inequality of moduli C again and again for
   *
   *     b(q) = loads + ∫ Dᵀ (kC Dq − s(Dq − f − r̂)),
   *
   * whose change is the residual of the solution. The same C, with its one
   * factor, serves for many steps and periods, with Anderson's acceleration of
   * b; where b changes hardly less than before, C is made anew. Where a step
   * goes beyond the least potential on its way, it is cut. Where that does not
   * converge, as with large n after a load at once, solutions of smaller c lead
   * to that of c.
   *
   * It starts from the last displacement and what that did between the same
   * instants of the period before.
   */
  template <int dim>
  class CreepStage
  {
  public:
    /** All arguments must outlive this object.
     *
     * @param tolerance of the residual, relative to the largest nodal force of
     * the loads. */
    CreepStage(const StrainOperator<dim> &strain_operator,
               const ExternalLoads<dim>  &loads,
               InstantProvider<dim>      &instants,
               const double               tolerance);

    /**
     * Solves for displacement, stress and contact forces.
     *
     * @param t instant within the period.
     * @param[in,out] state the last one; then the solution.
     * @param[out] right_hand_side b
     * @return what has solved the last variational inequality.
     * @throw NumericalError with the residual if it does not converge.
     */
    ContactSolver &
    solve(const double  t,
          const Vector &known,
          const double  c,
          State        &state,
          Vector       &right_hand_side);

    /** ṙ under a stress, such as that of the last solution.
     *
     * @param known r, or r̂ where r = r̂ + c ṙ.
     * @return the largest relaxation rate of this rank's points. */
    static double
    rates(const InelasticStrain<dim> &known,
          const double                c,
          const Vector               &stress,
          Vector                     &rate);

    /** Shows where the next stages start. */
    void
    serialize(StateArchive &archive);

  private:
    /** What belongs to the stage that is solved. */
    struct Stage
    {
      const double               t, c, log_kappa;
      const InelasticStrain<dim> known;
      Tangent<dim>               tangent;
      State                     &state;
    };

    struct Visit;

    /** Null: there is none. */
    Visit *
    visit_at(const double t);

    /** Adds what the displacement did at this instant of the last period. */
    void
    predict(const double t, Vector &displacement);

    /** Keeps the displacement for the next period. */
    void
    keep(const double t, const Vector &displacement);

    /** Sets the stress of the displacement, and b. */
    void
    evaluate(Stage &stage, Vector &right_hand_side);

    /** Newton's method from the displacement of the stage.
     *
     * @param enough Residual that ends it, relative to the largest nodal force.
     * @throw NumericalError with the residual if it does not converge. */
    ContactSolver &
    iterate(Stage &stage, const double enough, Vector &right_hand_side);

    /** Goes back on the way from the displacement before to the present one,
     * to about the least potential: where that is falls between them. */
    void
    cut_step(Stage &stage);

    const StrainOperator<dim> &strain_operator;
    const ExternalLoads<dim>  &loads;
    InstantProvider<dim>      &instants;
    const double               tolerance;

    Vector forces; ///< of the loads
    Vector excess; ///< kC Dq − s at points
    Vector next;   ///< b of the last displacement
    Vector before; ///< the displacement before that

    /** A displacement that a stage had in this period or the last one. */
    struct Visit
    {
      Vector       displacement;
      unsigned int period = 0; ///< counted from the first stage on
    };

    std::map<double, Visit> path; ///< by instants
    Vector                  last; ///< that of the stage before; empty: none
    double                  last_t = 0.; ///< of that stage
    unsigned int            period = 0;
  };
} // namespace Crevasse

#endif
