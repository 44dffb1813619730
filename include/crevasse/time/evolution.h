// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_time_evolution_h
#define crevasse_time_evolution_h

#include <crevasse/discretisation/external_loads.h>
#include <crevasse/time/creep_stage.h>
#include <crevasse/time/inelastic_strain.h>
#include <crevasse/time/instant_provider.h>
#include <crevasse/time/rate_equation.h>
#include <crevasse/time/state.h>
#include <crevasse/time/step_list.h>

namespace Crevasse
{
  /**
   * The right-hand side of the ODE (model, §2, and MaxwellLaw): for given
   * viscous strains rᵢ of the branches, and r = Σ wᵢ rᵢ,
   *
   *     k A q − b(r,t) = Lᵀ g,   0 ≤ g ⟂ L q − gap ≥ 0,
   *     b = ∫ Dᵀ kK (r + χθ) + loads,       s = kK (D q − χθ − r),
   *     ṙᵢ = η₀⁻¹ Hᵢ sᵢ − αᵢ,                sᵢ = k wᵢ K (D q − χθ − rᵢ)
   *
   * with the secular rates αᵢ of the split form; none in the unsplit one.
   * Where r is implicit, rᵢ = r̂ᵢ + c ṙᵢ, it is eliminated: the moduli are the
   * AlgorithmicModuli, and r̂ᵢ − cαᵢ stands for rᵢ. Each evaluation solves one
   * variational inequality, started from the last solution.
   */
  template <int dim>
  class Evolution : public RateEquation
  {
  public:
    /** All arguments must outlive this object.
     *
     * @param newton_tolerance see CreepStage. */
    Evolution(const StrainOperator<dim>  &strain_operator,
              const QuadratureField<dim> &points,
              const ExternalLoads<dim>   &loads,
              InstantProvider<dim>       &instants,
              const double                newton_tolerance = 0.);

    /** Splits off a secular flow, which must outlive this object: q and r are
     * periodic then. */
    void
    split_off(const SecularFlow &secular_flow)
    {
      flow = &secular_flow;
    }

    /** From now on times of the equation are brought into the period of these
     * steps, which must outlive this object. */
    void
    repeat(const StepList &steps)
    {
      period = &steps;
    }

    /** A step begins at @p t: where something jumps at its end, it sees what
     * was before. */
    void
    begin_step(const double t)
    {
      step_begin = t;
    }

    /** The flow that is split off; null: none. */
    const SecularFlow *
    secular_flow() const
    {
      return flow;
    }

    void
    rate(const double t, const Vector &r, Vector &rate) override;

    void
    implicit_rate(const double  t,
                  const Vector &known,
                  const double  c,
                  Vector       &rate) override;

    void
    semi_implicit_rate(const double  t,
                       const Vector &predicted,
                       const Vector &known,
                       const double  c,
                       Vector       &rate) override;

    void
    apply_relaxation(const unsigned int order,
                     const double       t,
                     const double       c,
                     Vector            &values) override;

    double
    stress_scale() const override
    {
      return elastic_stress;
    }

    /** Whether evaluations repeat to the last bit: rates are linear in the
     * stress, and the contact solver of the last one is exact. */
    bool
    repeats_exactly() const
    {
      return fastest < 0. && last_solver->is_exact();
    }

    double
    relaxation_rate() const override;

    std::size_t
    n_evaluations() const override
    {
      return statistics().rate_evaluations;
    }

    /** Counts and largest errors of the run so far. */
    SolverStatistics
    statistics() const
    {
      SolverStatistics all = instants.statistics();
      all.rate_evaluations += evaluations;
      return all;
    }

    void
    strain_per_stress(const Vector &r, Vector &scale) const override;

    void
    switching_functions(std::vector<double> &values) const override
    {
      last_solver->complementarity_functions(last.displacement,
                                             last.contact_forces.normal,
                                             last.stiffness_factor,
                                             values);
    }

    /** Makes stress scale and strain per stress those of the largest elastic
     * stress and of the largest stiffness of each point at these instants.
     * Collective. */
    void
    set_scales(const Space<dim> &space, const std::vector<double> &instants);

    /** The state of a body without viscous strain at the instant @p t. */
    void
    elastic_state(const double t);

    /** What the last evaluation has solved. */
    const State &
    state() const
    {
      return last;
    }

    /** b of the last evaluation. */
    const Vector &
    right_hand_side() const
    {
      return loading;
    }

    /** Shows what the last evaluation has solved, where the next one starts. */
    void
    serialize(StateArchive &archive)
    {
      archive.section("evolution");
      last.serialize(archive);
      archive.nodal(loading);
      archive.maximum(fastest);
      creep_stage.serialize(archive);
    }

  private:
    const StrainOperator<dim> &strain_operator;
    const ExternalLoads<dim>  &loads;
    InstantProvider<dim>      &instants;
    const SecularFlow         *flow       = nullptr; ///< none: unsplit
    const StepList            *period     = nullptr; ///< none: any time
    double                     step_begin = 0.;

    /** The instant within the period at which @p t is evaluated. */
    double
    instant_of(const double t) const
    {
      if (period == nullptr)
        return t;
      return t > step_begin && period->jumps_at(t) ? period->just_before(t)
                                                   : period->within_period(t);
    }

    /** Solves for q with a given viscous strain; empty: none. */
    void
    solve_explicitly(const double        t,
                     const Instant<dim> &instant,
                     const Vector       &r);

    /** Solves the variational inequality for q with the right-hand side that
     * was made.
     *
     * @param k the factor of the contact solver's stiffness. */
    void
    solve(ContactSolver &contact_solver, const double k);

    /** r̂ᵢ − cαᵢ of the point and branch whose strain is at @p place. */
    VoigtVector<dim>
    known_strain(const Vector     &known,
                 const std::size_t place,
                 const double      c) const;

    /** Stress and rates for the last displacement.
     *
     * @param branch_stress sᵢ/k of (point, branch i, place of its strain,
     * e − χθ). */
    template <typename BranchStress>
    void
    stress_and_rates(const InelasticStrain<dim> &inelastic,
                     const BranchStress         &branch_stress,
                     Vector                     &rate);

    /** The same with r implicit, for the last displacement. */
    void
    implicit_rates(const ImplicitInstant<dim> &instant,
                   const Vector               &known,
                   const double                c,
                   Vector                     &rate);

    /** Stress of the last displacement. */
    void
    set_stress(const InelasticStrain<dim> &inelastic);

    /** Stress and rate of one Maxwell body that is the same everywhere. */
    void
    plain_rate(const MaterialState<dim> &material,
               const Vector             &r,
               Vector                   &rate);

    ContactSolver *last_solver = nullptr; ///< of the last evaluation

    // See set_scales().
    double              elastic_stress = 0.;
    std::vector<double> stress_scales; ///< √(dV/V) |kK| of each point
    std::vector<double> fractions;     ///< wᵢ

    /** Of this rank's points in the last evaluation: see relaxation_rate();
     * negative: the stress has no say. */
    double fastest = -1.;

    std::size_t evaluations = 0; ///< by this object

    State  last;
    Vector loading;

    CreepStage<dim> creep_stage;
  };
} // namespace Crevasse

#endif
