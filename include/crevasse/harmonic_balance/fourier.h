// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_harmonic_balance_fourier_h
#define crevasse_harmonic_balance_fourier_h

#include <crevasse/harmonic_balance/fourier_problem.h>
#include <crevasse/harmonic_balance/harmonic_responses.h>
#include <crevasse/secular/viscosity.h>

#include <deal.II/lac/linear_operator.h>
#include <deal.II/lac/precondition.h>
#include <deal.II/lac/solver_cg.h>

namespace Crevasse
{
  /**
   * Finds the periodic state by harmonic balance: a Fourier series in time (the
   * paper's Remark 1; model, §2 and §3). K and H do not depend on time, so each
   * harmonic n of the loads is a problem of its own,
   *
   *     A*ₙ qₙ = Fₙ + ∫ Dᵀ k K*ₙ χθₙ + Lᵀ gₙ,     rᵢₙ = Hᵢ sᵢₙ / (η₀ zₙ),
   *
   * with the ComplexModuli K*ₙ and the zₙ of Harmonics. Only the contact forces
   * couple the harmonics; they follow from a PeriodicContactProblem on the lip.
   * With a spring the mean is another harmonic, n = 0, with the moduli that
   * remain (κ infinite). Otherwise
   * the mean stress is that of the secular flow, s̄ᵢ = η₀ ηᵢ Dβ, and only the
   * lip bounds the mean of the displacement: on the lip it is the offsets of
   * the contact problem, or what keeps unloaded nodes from penetrating; in the
   * body it has the least elastic energy.
   */
  template <int dim>
  class Fourier
  {
  public:
    using ContactMethod =
      std::function<PeriodicContactSolution(const PeriodicContactProblem &)>;

    /** Samples loads and thermal strain. The arguments must outlive the Fourier
     * object. Collective.
     *
     * @param body whose K and H do not depend on time, with a spring or without
     * a singular H.
     * @param linear_solver of the stiffness without its factor k.
     * @throw SceneError if a formula has no value. */
    Fourier(const Body<dim> &body,
            const Harmonics &harmonics,
            LinearSolver    &linear_solver);

    /** Mean of the load samples divided by η₀: load of the secular problem. */
    Vector
    mean_load() const
    {
      Vector mean = load[0];
      mean /= material.viscosity_factor;
      return mean;
    }

    /** Size of a load, divided by η₀, that is rounding of the samples. */
    double
    negligible_load() const
    {
      constexpr double rounding = 1e-12;
      return rounding * largest_load / material.viscosity_factor;
    }

    /** Solves all harmonics, with contact. Collective.
     *
     * @param flow caused by mean_load(); null: that load vanishes.
     * @param solve_contact called if a node bears a mean force, or there are a
     * lip and a spring, on all ranks with the same problem.
     * @param memory for complex factors, in bytes, of all ranks.
     * @throw NumericalError if MUMPS fails, and what @p solve_contact throws.
     */
    PeriodicMotion
    solve(const SecularFlow   *flow,
          const ContactMethod &solve_contact,
          const double         memory) const;

  private:
    using Complex = std::complex<double>;

    /** Argument κ of the ComplexModuli of harmonic n. */
    Complex
    kappa(const unsigned int n) const
    {
      if (n == 0)
        return std::numeric_limits<double>::infinity();
      return harmonics.integral(n) * material.stiffness_factor /
             material.viscosity_factor;
    }

    bool
    has_spring() const
    {
      return material.spring > 0.;
    }

    /** The first harmonic that is solved for. */
    unsigned int
    first_harmonic() const
    {
      return has_spring() ? 0 : 1;
    }

    /** Real part of harmonic n among coefficients. */
    static unsigned int
    real_part(const unsigned int n)
    {
      return n == 0 ? 0 : 2 * n - 1;
    }

    ComplexModuli<dim>
    moduli(const unsigned int n) const
    {
      return ComplexModuli<dim>(material, kappa(n), body.points.n_local_points);
    }

    /** Harmonic χθₙ of the thermal strain at a point. */
    VoigtVector<dim, Complex>
    thermal_harmonic(const unsigned int n, const std::size_t offset) const;

    /** Adds the thermal load ∫ Dᵀ k K* χθₙ of a harmonic. */
    void
    add_thermal_load(const unsigned int        n,
                     const ComplexModuli<dim> &moduli,
                     Vector                   &real,
                     Vector                   &imaginary) const;

    /** Overwrites the loads by displacements without contact, except the mean
     * if nothing but the lip bounds it, and returns the contact problem.
     * Harmonics without load are not solved; their displacement is zero. */
    PeriodicContactProblem
    respond(HarmonicResponses<dim> &responses,
            const LipPart          &part,
            PeriodicMotion         &motion) const;

    /** Adds contact forces, and the displacement that they cause. */
    void
    add_contact(const PeriodicContactSolution &contact,
                HarmonicResponses<dim>        &responses,
                const LipPart                 &part,
                PeriodicMotion                &motion) const;

    /** Computes the viscous strain rₙ from the displacement qₙ. */
    void
    find_viscous_strain(const unsigned int n, PeriodicMotion &motion) const;

    /** The mean opening u_N at all nodes of the lip.
     *
     * @param offsets of the nodes of @p part. */
    dealii::Vector<double>
    mean_on_lip(const LipPart                &part,
                const dealii::Vector<double> &offsets,
                const PeriodicMotion         &motion) const
    {
      auto values = harmonics.zero(dealii::Vector<double>(lip.n_nodes()));
      for (unsigned int k = 1; k < values.size(); ++k)
        values[k] = lip.restrict_to_lip(motion.displacement[k]);
      harmonics.synthesise(values);

      dealii::Vector<double> ones(part.n_nodes());
      std::fill(ones.begin(), ones.end(), 1.); // may be empty
      const auto is_in_part = lip.gather(part.scatter(ones));
      auto       mean       = lip.gather(part.scatter(offsets));
      for (unsigned int i = 0; i < mean.size(); ++i)
        {
          // A node that bears no mean force is never pressed: it just touches.
          double least = std::numeric_limits<double>::max();
          for (const dealii::Vector<double> &value : values)
            least = std::min(least, value(i));
          mean(i) = lip.nodes.gap[i] + (is_in_part(i) > 0. ? mean(i) : -least);
        }
      return mean;
    }

    /** Finds the mean displacement of least elastic energy, given its lip
     * values. */
    void
    find_mean_displacement(const dealii::Vector<double> &on_lip,
                           Vector                       &mean) const
    {
      mean = 0.;
      if (on_lip.size() == 0 || on_lip.linfty_norm() == 0.)
        return;
      // The displacement of least energy is A⁻¹ Lᵀ g of forces g at the lip;
      // each product with L A⁻¹ Lᵀ takes a back-solve. A slow material
      // remembers this displacement for many periods, so the accuracy is high:
      // otherwise results would depend on where rounding ends the iteration.
      constexpr double accuracy = 1e-13, accuracy_of_product = 1e-12;
      Vector           loads(mean);
      const auto       displace = [&](const LipVector &forces) {
        loads = 0.;
        mean  = 0.;
        lip.add_forces(1., forces, loads);
        linear_solver.solve(mean,
                            loads,
                            accuracy_of_product * forces.l2_norm());
      };
      dealii::LinearOperator<LipVector> compliance;
      compliance.vmult = [&](LipVector &opening, const LipVector &forces) {
        displace(forces);
        opening = lip.restrict_to_lip(mean);
      };
      LipVector                      forces(lip.n_nodes());
      dealii::IterationNumberControl control(10 * lip.n_nodes() + 100,
                                             accuracy * on_lip.l2_norm());
      dealii::SolverCG<LipVector>(control).solve(
        compliance, forces, on_lip, dealii::PreconditionIdentity());
      displace(forces);
      // The displacement on the lip is exactly as given.
      LipVector rest(on_lip);
      rest -= lip.restrict_to_lip(mean);
      lip.add_forces(1., rest, mean);
    }

    void
    find_mean_viscous_strain(const SecularFlow *flow,
                             PeriodicMotion    &motion) const
    {
      using Field                   = QuadratureField<dim>;
      const unsigned int n_branches = material.fluidity.size();
      const std::size_t  n_points   = body.points.n_local_points;
      const double       stress_factor =
        material.viscosity_factor / material.stiffness_factor;

      // Elastic strain under the mean stress: (k wᵢ K)⁻¹ s̄ᵢ.
      std::optional<Viscosity<dim>>                viscosity;
      std::optional<PointValues<VoigtMatrix<dim>>> compliance;
      if (flow != nullptr)
        {
          viscosity.emplace(body, material);
          compliance = transform(*material.stiffness, n_points, inverse<dim>);
        }
      std::optional<ComplexModuli<dim>> remaining;
      if (has_spring())
        {
          remaining.emplace(moduli(0));
          compliance = transform(*material.stiffness, n_points, inverse<dim>);
        }

      body.strain_operator.for_each_strain(
        motion.displacement[0],
        [&](const std::size_t offset, VoigtVector<dim> strain) {
          const std::size_t point = offset / Field::n_components;
          if (!thermal_strain.empty())
            strain -= Field::get(thermal_strain[0], offset);
          for (unsigned int i = 0; i < n_branches; ++i)
            {
              const std::size_t place =
                offset * n_branches + i * Field::n_components;
              VoigtVector<dim> r = strain;
              if (flow != nullptr)
                r -= stress_factor / material.fractions[i] *
                     ((*compliance)[point] *
                      (viscosity->branches[i][point] *
                       Field::get(flow->strain_rate, place)));
              if (remaining)
                {
                  VoigtVector<dim>                stress;
                  const VoigtVector<dim, Complex> all =
                    remaining->branches[i][point] *
                    VoigtVector<dim, Complex>(strain);
                  for (unsigned int c = 0; c < Field::n_components; ++c)
                    stress[c] = all[c].real();
                  r -= 1. / material.fractions[i] *
                       ((*compliance)[point] * stress);
                }
              if (material.plane_stress)
                r[voigt_index<dim>(2, 2)] = 0.; // not used
              Field::set(motion.viscous_strain[0], place, r);
            }
        });
    }

    const Body<dim>         &body;
    const Harmonics         &harmonics;
    LinearSolver            &linear_solver;
    const MaterialState<dim> material;
    const UnilateralBounds   bounds;
    const LipPart            lip; ///< all nodes of the lip

    // Coefficients of the harmonics of loads and thermal strain.
    std::vector<Vector> load;
    std::vector<Vector> thermal_strain; ///< mean only, or empty
    double              largest_load = 0.;
  };
} // namespace Crevasse

#endif
