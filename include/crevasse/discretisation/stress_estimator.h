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
  template <int dim>
  struct MaterialState;

  /**
   * How far stresses are from equilibrium, cell by cell, in the norm of their
   * elastic energy: with the compliance c (1/stress) of the cell
   *
   *     16 η² = c h²/p² ‖div s + φ₁‖² + c h/p (½ ‖[s n]‖² + ‖s n − φ₂‖² + …)
   *
   * over the cell, its inner faces and its faces at the boundary, where "…"
   * stands for tangential tractions on planes of symmetry and lips, and for
   * the normal one of the lip plus the contact pressure: that must vanish
   * where the lip is open, and bear the contact force where it is closed. The
   * stress is what the points have, not what the displacement alone would
   * cause, so that it contains the viscous strain.
   *
   * Looks at as many states as wanted; what counts for a cell is the largest
   * of its estimates.
   */
  template <int dim>
  class StressEstimator
  {
  public:
    /** All arguments must outlive this object. */
    StressEstimator(const Space<dim>           &space,
                    const QuadratureField<dim> &points,
                    const ContactBoundary<dim> &lip,
                    const LoadParameters       &loads);

    /** Collective.
     *
     * @param t Instant within the period.
     * @param contact_forces of the nodes of the lip on this rank.
     * @param elastic_displacement whose stress it is, where nothing creeps: the
     * stress of singular functions then counts as what it is, and is not
     * approximated by polynomials. */
    void
    look_at(const double               t,
            const Vector              &stress,
            const std::vector<double> &contact_forces,
            const MaterialState<dim>  &material,
            const Vector              *elastic_displacement = nullptr);

    /** The squares of the largest estimates so far over the largest energy, by
     * active cell index. */
    dealii::Vector<float>
    squares() const;

    /** ∫ s·K⁻¹s of the state where it is largest; 0 without stress. */
    double
    largest_energy() const
    {
      return most_energy;
    }

    /** The root of their sum over that of the largest energy norm of the
     * stress so far; 0 without stress. Collective. */
    double
    relative_error() const;

    void
    serialize(StateArchive &archive)
    {
      archive.on_cells(largest);
      archive.common(most_energy);
    }

  private:
    /** The compliance of the cells that this rank sees. */
    std::vector<double>
    compliances(const MaterialState<dim> &material) const;

    /** ∫ s·K⁻¹s over all ranks. */
    double
    energy(const Vector &stress, const MaterialState<dim> &material) const;

    /** The coefficients c_k of singular functions; none if there is no
     * displacement, as without such functions, and with two lips, where they
     * are cut off and no more in equilibrium: then what they describe counts as
     * error. */
    std::vector<double>
    singular_coefficients(const Vector *displacement) const;

    /** K Σ c_k Dψ_k, not shifted: what is left without it is the stress of
     * polynomials. w₁ and w₃ are in equilibrium and leave the lip free; what D
     * lacks is left out of account, for an elastic body has hardly any of it.
     */
    VoigtVector<dim>
    singular_stress(const std::vector<double> &coefficients,
                    const dealii::Point<dim>  &point,
                    const dealii::Point<dim>  &cell_center,
                    const VoigtMatrix<dim>    &stiffness) const;

    const Space<dim>           &space;
    const QuadratureField<dim> &points;
    const ContactBoundary<dim> &lip;
    const LoadParameters       &loads;
    const CellPolynomials<dim>  polynomials;
    dealii::Vector<double>      largest; ///< of the squares
    double                      most_energy = 0.;
  };
} // namespace Crevasse

#endif
