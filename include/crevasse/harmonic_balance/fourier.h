// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_harmonic_balance_fourier_h
#define crevasse_harmonic_balance_fourier_h

#include <crevasse/harmonic_balance/fourier_problem.h>
#include <crevasse/harmonic_balance/harmonic_responses.h>


namespace Crevasse
{
  /**
   * The periodic state without marching: direct Fourier treatment in time (the
   * paper's Remark 1; model, §2 and §3). K and H do not depend on time, so each
   * harmonic n of the loads is a problem of its own,
   *
   *     A*ₙ qₙ = Fₙ + ∫ Dᵀ k K*ₙ χθₙ + Lᵀ gₙ,     rᵢₙ = Hᵢ sᵢₙ / (η₀ zₙ),
   *
   * with the ComplexModuli K*ₙ and the zₙ of Harmonics. Only the contact forces
   * tie them together: they are found on the lip alone, as a
   * PeriodicContactProblem. The mean stress is that of the secular flow,
   * s̄ᵢ = η₀ ηᵢ Dβ. Only the lip bounds the mean of the displacement: it
   * takes the offsets of the contact problem, or what keeps other nodes from
   * penetrating, and in the body what costs least elastic energy.
   */
  template <int dim>
  class Fourier
  {
  public:
    using ContactMethod =
      std::function<PeriodicContactSolution(const PeriodicContactProblem &)>;

    /** Samples loads and thermal strain. All arguments must outlive this
     * object. Collective.
     *
     * @param body whose K and H do not depend on time, without a singular H.
     * @param linear_solver of the stiffness without its factor k.
     * @throw SceneError if a formula has no value. */
    Fourier(const Body<dim> &body,
            const Harmonics &harmonics,
            LinearSolver    &linear_solver);

    /** The mean of the samples divided by η₀: the load of the secular
     * problem. */
    Vector
    mean_load() const;

    /** The load that counts as none beside the samples, divided by η₀. */
    double
    negligible_load() const;

    /** Collective.
     *
     * @param flow of mean_load(); null: that vanishes.
     * @param solve_contact called if a node bears a mean force, on all ranks
     * with the same problem.
     * @param memory for complex factors, in bytes, of all ranks.
     * @throw NumericalError if MUMPS fails, and what @p solve_contact throws.
     */
    PeriodicMotion
    solve(const SecularFlow   *flow,
          const ContactMethod &solve_contact,
          const double         memory) const;

  private:
    using Complex = std::complex<double>;

    /** κ of harmonic n; see ComplexModuli. */
    Complex
    kappa(const unsigned int n) const;

    ComplexModuli<dim>
    moduli(const unsigned int n) const;

    /** χθₙ at a point; 0 if only its mean is there. */
    VoigtVector<dim, Complex>
    thermal_harmonic(const unsigned int n, const std::size_t offset) const;

    /** Adds ∫ Dᵀ k K* χθₙ. */
    void
    add_thermal_load(const unsigned int        n,
                     const ComplexModuli<dim> &moduli,
                     std::vector<Vector>      &loads) const;

    /** Overwrites loads by displacements without contact, all but the mean, and
     * states the contact problem. Those that are not loaded are left alone and
     * become zero. */
    PeriodicContactProblem
    respond(HarmonicResponses<dim> &responses,
            const LipPart          &part,
            PeriodicMotion         &motion) const;

    /** Adds what the contact forces do. */
    void
    add_contact(const PeriodicContactSolution &contact,
                HarmonicResponses<dim>        &responses,
                const LipPart                 &part,
                PeriodicMotion                &motion) const;

    /** rₙ for the displacement qₙ. */
    void
    find_viscous_strain(const unsigned int n, PeriodicMotion &motion) const;

    /** The mean of u_N at all nodes of the lip.
     *
     * @param offsets of the nodes of @p part. */
    dealii::Vector<double>
    mean_on_lip(const LipPart                &part,
                const dealii::Vector<double> &offsets,
                const PeriodicMotion         &motion) const;

    /** Of least elastic energy. */
    void
    find_mean_displacement(const dealii::Vector<double> &on_lip,
                           Vector                       &mean) const;

    void
    find_mean_viscous_strain(const SecularFlow *flow,
                             PeriodicMotion    &motion) const;

    const Body<dim>         &body;
    const Harmonics         &harmonics;
    LinearSolver            &linear_solver;
    const MaterialState<dim> material;
    const UnilateralBounds   bounds;
    const LipPart            lip; ///< all of it

    // Coefficients of harmonics.
    std::vector<Vector> load;
    std::vector<Vector> thermal_strain; ///< the mean alone, or none
    double              largest_load = 0.;
  };
} // namespace Crevasse

#endif
