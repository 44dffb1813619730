// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_periodic_viscous_coordinates_h
#define crevasse_periodic_viscous_coordinates_h

#include <crevasse/discretisation/material_field.h>


namespace Crevasse
{
  /**
   * Coordinates y of a viscous strain in which the Euclidean norm is that of
   * the work of making it creep within a period,
   *
   *     |y|² = Σᵢ ∫ rᵢ : (ηᵢ / T) rᵢ,
   *
   * in which two motions of the body never move apart. In plane stress the
   * creep in thickness, which bears no stress, counts for nothing but is
   * carried along. ηᵢ is limited to 1e4 T wᵢ K.
   */
  template <int dim>
  class ViscousCoordinates
  {
  public:
    /** @param material whose fluidity is that of the norm.
     * @param creep_time the period, times the mean of 1/η₀ over it. */
    ViscousCoordinates(const Space<dim>           &space,
                       const QuadratureField<dim> &points,
                       const MaterialState<dim>   &material,
                       const double                creep_time);

    /** y, with the layout of r. */
    void
    from_strain(const Vector &r, Vector &y) const
    {
      transform(false, r, y);
    }

    void
    to_strain(const Vector &y, Vector &r) const
    {
      transform(true, y, r);
    }

  private:
    using Matrices = PointValues<VoigtMatrix<dim>>;

    void
    transform(const bool to_strain, const Vector &source, Vector &target) const;

    std::vector<double> weights; ///< √(det J × weight) of each point
    // For each branch
    std::vector<Matrices> roots;    ///< Lᵀ with ηᵢ / T = L Lᵀ
    std::vector<Matrices> inverses; ///< L⁻ᵀ
  };
} // namespace Crevasse

#endif
