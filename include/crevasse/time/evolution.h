// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_time_evolution_h
#define crevasse_time_evolution_h

#include <crevasse/discretisation/external_loads.h>
#include <crevasse/lip/friction.h>
#include <crevasse/time/creep_stage.h>
#include <crevasse/time/inelastic_strain.h>
#include <crevasse/time/instant_provider.h>
#include <crevasse/time/lip_history.h>
#include <crevasse/time/rate_equation.h>
#include <crevasse/time/state.h>
#include <crevasse/time/step_list.h>

namespace Crevasse
{
  /**
   * Right-hand side of the ODE (model, §2, and MaxwellLaw): for given viscous
   * strains rᵢ of the branches, and r = Σ wᵢ rᵢ,
   *
   *     k A q − b(r,t) = Lᵀ g,   0 ≤ g ⟂ L q − gap ≥ 0,
   *     b = ∫ Dᵀ kK (r + χθ) + loads,       s = kK (D q − χθ − r),
   *     ṙᵢ = η₀⁻¹ Hᵢ sᵢ − αᵢ,                sᵢ = k wᵢ K (D q − χθ − rᵢ)
   *
   * with the secular rates αᵢ of the split form (0 without split). An implicit
   * rᵢ = r̂ᵢ + c ṙᵢ is eliminated: the moduli are the AlgorithmicModuli, and
   * r̂ᵢ − cαᵢ replaces rᵢ. Each evaluation solves a variational inequality,
   * starting from the last solution.
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

    /** Lets the lips bear friction, if any, from a state of rest on. */
    void
    slide_with(const std::optional<Friction<dim>> &law)
    {
      if (!law)
        return;
      friction                       = &*law;
      last.friction                  = law->at_rest();
      last.contact_forces.tangential = last.friction.reference;
    }

    bool
    has_friction() const
    {
      return friction != nullptr;
    }

    void
    commit() override
    {
      if (friction != nullptr)
        friction->commit(last.displacement, last.friction);
    }

    std::vector<std::vector<double>>
    committed_jumps() const override
    {
      return last.friction.reference;
    }

    void
    return_to(const std::vector<std::vector<double>> &jumps) override
    {
      last.friction.reference = jumps;
    }

    /** Maps times of the equation into the period of these steps, which must
     * outlive this object, from now on. */
    void
    repeat(const StepList &steps)
    {
      period = &steps;
    }

    /** Marks @p t as the beginning of a step: at a jump at its end, the step
     * sees values before the jump. */
    void
    begin_step(const double t)
    {
      step_begin = t;
    }

    /** Counts viscous strains of the equation from a strain r₀ from now on:
     * integrators see d = r − r₀, with its own relative accuracy, however
     * large r₀ is. Not for creep that hardens.
     * @param strain r₀, which must outlive its use, or null. */
    void
    count_from(const Vector *strain)
    {
      base = strain;
    }

    bool
    counts_from_strain() const
    {
      return base != nullptr;
    }

    /** Records the lip at all evaluations from now on, or no longer if
     * @p history is null. */
    void
    record(LipHistory *history)
    {
      lip_history = history;
    }

    /** Flow that is split off, or null. */
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

    /** Whether evaluations repeat to the last bit from r alone: creep is
     * linear, the last contact solver is exact, and no friction remembers. */
    bool
    repeats_exactly() const
    {
      return fastest < 0. && friction == nullptr && last_solver->is_exact();
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
    switching_functions(std::vector<std::vector<double>> &values) const override
    {
      values.resize(friction == nullptr ? 1 : 2);
      last_solver->complementarity_functions(last.displacement,
                                             last.contact_forces.normal,
                                             last.stiffness_factor,
                                             values.front());
      if (friction != nullptr)
        last_solver->stick_functions(last.displacement,
                                     last.contact_forces,
                                     last.stiffness_factor,
                                     last.friction,
                                     values.back());
    }

    /** Sets stress_scale() by the largest elastic stress, strain_per_stress()
     * by the largest stiffness of each point, at these instants. Collective. */
    void
    set_scales(const Space<dim> &space, const std::vector<double> &instants);

    /** Computes the state without viscous strain at the instant @p t. */
    void
    elastic_state(const double t);

    /** State that the last evaluation computed. */
    const State &
    state() const
    {
      return last;
    }

    /** Right-hand side b of the last evaluation. */
    const Vector &
    right_hand_side() const
    {
      return loading;
    }

    /** Serialises the last solution, from which the next evaluation starts. */
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
    const SecularFlow         *flow        = nullptr; ///< null: unsplit
    const Friction<dim>       *friction    = nullptr; ///< null: none
    const StepList            *period      = nullptr; ///< null: any time
    const Vector              *base        = nullptr; ///< r₀, or null
    LipHistory                *lip_history = nullptr; ///< null: not recorded
    double                     step_begin  = 0.;

    /** Instant within the period at which @p t is evaluated. */
    double
    instant_of(const double t) const
    {
      if (period == nullptr)
        return t;
      return t > step_begin && period->jumps_at(t) ? period->just_before(t)
                                                   : period->within_period(t);
    }

    /** Keeps the solver of the last state, and records the lip. */
    void
    note(ContactSolver &solver)
    {
      last_solver = &solver;
      if (lip_history != nullptr)
        lip_history->record(last.instant, last);
    }

    /** State of friction with the coefficients of @p t, or null. */
    const FrictionState *
    friction_at(const double t)
    {
      if (friction == nullptr)
        return nullptr;
      friction->evaluate(t, last.friction);
      return &last.friction;
    }

    /** Solves for q with a given viscous strain, or none if it is empty. */
    void
    solve_explicitly(const double        t,
                     const Instant<dim> &instant,
                     const Vector       &r);

    /** Solves the variational inequality for q with the right-hand side b of
     * the instant @p t.
     *
     * @param k factor of the contact solver's stiffness. */
    void
    solve(const double t, ContactSolver &solver, const double k);

    /** Known strain r̂ᵢ − cαᵢ of the point and branch at offset @p place. */
    VoigtVector<dim>
    known_strain(const InelasticStrain<dim> &known,
                 const std::size_t           place,
                 const double                c) const;

    /** Computes stress and rates for the last displacement.
     *
     * @param branch_stress sᵢ/k as a function of point, branch i, offset of its
     * strain, and e − χθ. */
    template <typename BranchStress>
    void
    stress_and_rates(const InelasticStrain<dim> &inelastic,
                     const BranchStress         &branch_stress,
                     Vector                     &rate);

    /** Computes stress and rates for the last displacement if r is implicit. */
    void
    implicit_rates(const ImplicitInstant<dim> &instant,
                   const Vector               &known,
                   const double                c,
                   Vector                     &rate);

    /** Computes the stress of the last displacement. */
    void
    set_stress(const InelasticStrain<dim> &inelastic);

    /** Computes stress and rate of a homogeneous body with one branch. */
    void
    plain_rate(const MaterialState<dim> &material,
               const Vector             &r,
               Vector                   &rate);

    ContactSolver *last_solver = nullptr; ///< solver of the last evaluation

    // See set_scales().
    double              elastic_stress = 0.;
    std::vector<double> stress_scales; ///< √(dV/V) |kK| of each point
    std::vector<double> fractions;     ///< fractions wᵢ

    /** Largest relaxation rate at this rank's points in the last evaluation;
     * negative if creep is linear. */
    double fastest = -1.;

    std::size_t evaluations = 0; ///< evaluations by this object

    State  last;
    Vector loading;

    CreepStage<dim> creep_stage;
  };
} // namespace Crevasse

#endif
