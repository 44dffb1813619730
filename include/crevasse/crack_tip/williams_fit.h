// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_crack_tip_williams_fit_h
#define crevasse_crack_tip_williams_fit_h

#include <crevasse/crack_tip/tip_region.h>
#include <crevasse/discretisation/contact_boundary.h>

namespace Crevasse
{
  /**
   * The stress intensity factor K_I as a linear function of the stress at the
   * quadrature points: Williams' series with n = 1 … N is fitted, by least
   * squares over area, to the stress in the half discs r ≤ R and r ≤ 2R, and
   *
   *     K_I = 2 K(R) − K(2R).
   *
   * The extrapolation takes away what grows with R, as the stress between parts
   * that creep differently does. Nothing needs to be elastic.
   *
   * The series knows no pressure on the lip: a straight line p₀ + p₁r is fitted
   * to that of the contact forces, and the stress −(p₀ − p₁X) e₂ ⊗ e₂, which
   * has it, is taken from the stress before. (As unknowns of the fit such terms
   * would ruin it: that an open lip bears nothing is most of what is known.)
   */
  class WilliamsFit
  {
  public:
    /** Collective.
     *
     * @param radius 2R, of the larger disc. */
    WilliamsFit(const PointGeometry      &points,
                const ContactBoundary<2> &lip,
                const TipRegion          &region,
                const double              radius,
                const MPI_Comm            communicator);

    /** K_I. Collective. */
    double
    value(const Vector &stress, const std::vector<double> &contact_forces) const
    {
      return 2. * apply(small, stress, contact_forces) -
             apply(large, stress, contact_forces);
    }

    /** K(R) − K(2R): what the extrapolation adds. Collective. */
    double
    correction(const Vector              &stress,
               const std::vector<double> &contact_forces) const
    {
      return apply(small, stress, contact_forces) -
             apply(large, stress, contact_forces);
    }

    /** The least radius whose half disc has enough points for all terms.
     * Collective. */
    static double
    least_radius(const PointGeometry &points,
                 const TipRegion     &region,
                 const MPI_Comm       communicator);

  private:
    /** What the stress at a point, at this local index, contributes. */
    using Row = std::pair<std::size_t, VoigtVector<2>>;

    /** K as a linear function. */
    struct Disc
    {
      double              radius;
      std::vector<Row>    of_stress;
      std::vector<double> of_contact_forces; ///< for each local lip node
    };

    Disc
    fit(const PointGeometry      &points,
        const ContactBoundary<2> &lip,
        const TipRegion          &region,
        const double              radius) const;

    /** What the rows of a disc make of the stress of p₀ = 1, and of p₁ = 1/R.
     */
    dealii::Tensor<1, 2>
    of_pressure(const PointGeometry &points,
                const CrackTip      &tip,
                const Disc          &disc) const;

    void
    fit_pressure(const PointGeometry      &points,
                 const ContactBoundary<2> &lip,
                 const CrackTip           &tip,
                 Disc                     &disc) const;

    double
    apply(const Disc                &disc,
          const Vector              &stress,
          const std::vector<double> &contact_forces) const;

    const MPI_Comm communicator;
    const Disc     small, large;
  };
} // namespace Crevasse

#endif
