// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_discretisation_stress_estimator_h
#define crevasse_discretisation_stress_estimator_h

#include <crevasse/base/state_archive.h>
#include <crevasse/discretisation/cell_polynomials.h>
#include <crevasse/parameters/parameters.h>

namespace Crevasse
{
  template <int dim>
  class ContactBoundary;
  struct ContactForces;
  template <int dim>
  struct MaterialState;
  template <int dim>
  class ResidualWeight;

  /**
   * Error estimator: residual of the equilibrium of stresses in each cell, in
   * the norm of their elastic energy: with the compliance c (1/stress) of the
   * cell
   *
   *     16 η² = c h²/p² ‖div s + φ₁‖² + c h/p (½ ‖[s n]‖² + ‖s n − φ₂‖² + …)
   *
   * over the cell, its inner faces and its faces at the boundary, where "…"
   * stands for tangential tractions on planes of symmetry and lips, and for the
   * normal traction of the lip plus the contact pressure, which vanishes where
   * the lip is open, and balances the contact force where it is closed. The
   * stress is that at the points, not that of the displacement alone, so that
   * it contains the viscous strain.
   *
   * Any number of states may be estimated; the largest estimate of a cell
   * counts.
   */
  template <int dim>
  class StressEstimator
  {
  public:
    /** Makes an estimator without estimates. All arguments must outlive it. */
    StressEstimator(const Space<dim>           &space,
                    const QuadratureField<dim> &points,
                    const ContactBoundary<dim> &lip,
                    const LoadParameters       &loads);

    /** Estimates the error of a state. Collective.
     *
     * @param t Instant within the period.
     * @param elastic_displacement Displacement of an elastic stress, if nothing
     * creeps: the stress of singular functions then counts exactly, and is not
     * approximated by polynomials. */
    void
    look_at(const double              t,
            const Vector             &stress,
            const ContactForces      &contact_forces,
            const MaterialState<dim> &material,
            const Vector             *elastic_displacement = nullptr);

    /** Squares of the largest estimates so far, divided by the largest energy,
     * by active cell index. */
    dealii::Vector<float>
    squares() const;

    /** Squares of the largest estimates so far, by active cell index. */
    const dealii::Vector<double> &
    largest_squares() const
    {
      return largest;
    }

    /** Largest energy ∫ s·K⁻¹s of all states; 0 without stress. */
    double
    largest_energy() const
    {
      return most_energy;
    }

    /** Relative error: root of the sum of squares(); 0 without stress.
     * Collective. */
    double
    relative_error() const;

    void
    serialize(StateArchive &archive)
    {
      archive.on_cells(largest);
      archive.common(most_energy);
    }

  private:
    /** Weights of the residuals in the cells that this rank sees. */
    std::vector<ResidualWeight<dim>>
    weights(const MaterialState<dim> &material) const;

    /** Energy ∫ s·K⁻¹s over all ranks. */
    double
    energy(const Vector &stress, const MaterialState<dim> &material) const;

    /** Coefficients c_k of singular functions; empty without a displacement or
     * singular functions. */
    std::vector<double>
    singular_coefficients(const Vector *displacement) const;

    /** Stress K Σ c_k Dψ_k with ψ_k, not φ_k: the rest is the stress of
     * polynomials. w₁ and w₃ are in equilibrium with free lips; the residual
     * of D is neglected, because an elastic body has little of it. */
    VoigtVector<dim>
    singular_stress(const std::vector<double> &coefficients,
                    const dealii::Point<dim>  &point,
                    const dealii::Point<dim>  &cell_center,
                    const VoigtMatrix<dim>    &stiffness) const;

    /** Divergence of singular_stress() where the functions are cut off by χ: of
     * χψ less χ times that of ψ, by differences. */
    dealii::Tensor<1, dim>
    cut_off_force(const std::vector<double>            &coefficients,
                  const dealii::Point<dim>             &point,
                  const dealii::CellAccessor<dim, dim> &cell,
                  const VoigtMatrix<dim>               &stiffness) const;

    const Space<dim>           &space;
    const QuadratureField<dim> &points;
    const ContactBoundary<dim> &lip;
    const LoadParameters       &loads;
    const CellPolynomials<dim>  polynomials;
    dealii::Vector<double>      largest; ///< largest squares
    double                      most_energy = 0.;
  };
} // namespace Crevasse

#endif
