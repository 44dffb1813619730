// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_crack_tip_williams_fit_h
#define crevasse_crack_tip_williams_fit_h

#include <crevasse/crack_tip/tip_region.h>
#include <crevasse/lip/contact_boundary.h>

namespace Crevasse
{
  /**
   * Computes the stress intensity factor K_I as a linear function of the stress
   * at the quadrature points: Williams' series with n = 1 … N is fitted, by
   * least squares over area, to the stress in the half discs r ≤ R and r ≤ 2R,
   * and
   *
   *     K_I = 2 K(R) − K(2R).
   *
   * The extrapolation removes errors linear in R, e.g. of the stress between
   * parts that creep differently. The body need not be elastic.
   *
   * The series has no pressure on the lip: a straight line p₀ + p₁r is fitted
   * to the pressure of the contact forces, and its stress −(p₀ − p₁X) e₂ ⊗ e₂
   * is subtracted before the fit. (These terms as unknowns would ruin the fit,
   * which mainly relies on an open lip being free.)
   */
  class WilliamsFit
  {
  public:
    /** Fits the series. Collective.
     *
     * @param radius 2R, of the larger disc. */
    WilliamsFit(const PointGeometry      &points,
                const ContactBoundary<2> &lip,
                const TipRegion          &region,
                const double              radius,
                const MPI_Comm            communicator);

    /** Computes K_I. Collective. */
    double
    value(const Vector &stress, const ContactForces &contact_forces) const
    {
      return 2. * apply(small, stress, contact_forces) -
             apply(large, stress, contact_forces);
    }

    /** K(R) − K(2R), which the extrapolation adds. Collective. */
    double
    correction(const Vector &stress, const ContactForces &contact_forces) const
    {
      return apply(small, stress, contact_forces) -
             apply(large, stress, contact_forces);
    }

    /** Least radius at which a half disc holds enough quadrature points to fit
     * all terms of Williams' series. Collective. */
    static double
    least_radius(const PointGeometry &points,
                 const TipRegion     &region,
                 const MPI_Comm       communicator);

  private:
    /** Factor of the stress at a point, with the point's local index. */
    using Row = std::pair<std::size_t, VoigtVector<2>>;

    /** K of a disc as a linear function of stress and contact forces. */
    struct Disc
    {
      double              radius;
      std::vector<Row>    of_stress;
      std::vector<double> of_contact_forces; ///< weights of local nodes
    };

    Disc
    fit(const PointGeometry      &points,
        const ContactBoundary<2> &lip,
        const TipRegion          &region,
        const double              radius) const;

    /** K by the rows of a disc for the stress of p₀ = 1, and of p₁ = 1/R. */
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
    apply(const Disc          &disc,
          const Vector        &stress,
          const ContactForces &contact_forces) const;

    const MPI_Comm communicator;
    const Disc     small, large;
  };
} // namespace Crevasse

#endif
