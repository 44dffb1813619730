// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_periodic_energy_coordinates_h
#define crevasse_periodic_energy_coordinates_h

#include <crevasse/discretisation/material_field.h>
#include <crevasse/discretisation/quadrature_field.h>
#include <crevasse/discretisation/space.h>

#include <vector>

namespace Crevasse
{
  /**
   * Coordinates y of a viscous strain in which the Euclidean norm is that of
   * the energy of the stress it takes to undo it,
   *
   *     |y|² = Σᵢ ∫ rᵢ : wᵢ K rᵢ,
   *
   * so that methods which combine viscous strains by inner products do not
   * depend on units, mesh grading or stiffness. In plane stress the creep in
   * thickness, which bears no stress, counts for nothing but is carried along.
   */
  template <int dim>
  class EnergyCoordinates
  {
  public:
    /** @param material whose stiffness is the one of the norm. */
    EnergyCoordinates(const Space<dim>           &space,
                      const QuadratureField<dim> &points,
                      const MaterialState<dim>   &material);

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

    std::vector<double> weights;   ///< √(det J × weight) of each point
    std::vector<double> fractions; ///< √wᵢ
    Matrices            roots;     ///< Lᵀ with K = L Lᵀ
    Matrices            inverses;  ///< L⁻ᵀ
  };
} // namespace Crevasse

#endif
