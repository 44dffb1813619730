// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_periodic_viscous_coordinates_h
#define crevasse_periodic_viscous_coordinates_h

#include <crevasse/discretisation/cell_values.h>
#include <crevasse/discretisation/material_field.h>
#include <crevasse/material/voigt_matrix.h>

namespace Crevasse
{
  /**
   * Coordinates y of a viscous strain r, whose Euclidean norm is the work of
   * creeping by r within a period,
   *
   *     |y|² = Σᵢ ∫ rᵢ : (ηᵢ / T) rᵢ.
   *
   * The distance of two motions of the body never grows in this norm. In plane
   * stress the creep in thickness direction, which bears no stress, is kept but
   * has negligible weight. ηᵢ is limited to 1e4 T wᵢ K.
   */
  template <int dim>
  class ViscousCoordinates
  {
  public:
    /** @param material with the fluidity of the norm.
     * @param creep_time the period, times the mean of 1/η₀ over it. */
    ViscousCoordinates(const Space<dim>           &space,
                       const QuadratureField<dim> &points,
                       const MaterialState<dim>   &material,
                       const double                creep_time)
    {
      constexpr double least = 1e-4; // least T/τ that counts
      for (std::size_t i = 0; i < material.fractions.size(); ++i)
        {
          const double w = material.fractions[i];
          roots.push_back(combine(
            *material.stiffness,
            *material.fluidity[i],
            points.n_local_points,
            [&](const VoigtMatrix<dim> &K, const VoigtMatrix<dim> &H) {
              const VoigtMatrix<dim> creep =
                creep_time * (material.plane_stress ? in_plane<dim>(H) : H);
              return root(inverse<dim>(creep + least / w * inverse<dim>(K)));
            }));
          inverses.push_back(Crevasse::transform(roots.back(),
                                                 points.n_local_points,
                                                 inverse_of_upper));
        }
      for_each_point(space,
                     dealii::update_JxW_values,
                     [this](const dealii::FEValues<dim> &values,
                            const unsigned int           q,
                            const std::size_t) {
                       weights.push_back(std::sqrt(values.JxW(q)));
                     });
    }

    /** Computes coordinates y, with the layout of r. */
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
    /** Cholesky factor Lᵀ with η = L Lᵀ. If the 33 row of η is zero, a
     * negligible entry replaces it, so that the matrix has an inverse. */
    static VoigtMatrix<dim>
    root(const VoigtMatrix<dim> &eta)
    {
      constexpr unsigned int n          = n_stress_components<dim>;
      constexpr double       negligible = 1e-6;
      VoigtMatrix<dim>       upper;
      for (unsigned int i = 0; i < n; ++i)
        for (unsigned int j = i; j < n; ++j)
          {
            double value = eta[i][j];
            for (unsigned int k = 0; k < i; ++k)
              value -= upper[k][i] * upper[k][j];
            if (j > i)
              upper[i][j] = value / upper[i][i];
            else
              upper[i][i] = eta[i][i] > 0. ? std::sqrt(value)
                                           : negligible * std::sqrt(eta.norm());
          }
      return upper;
    }

    /** Inverse of an upper triangular matrix, by columns from below. */
    static VoigtMatrix<dim>
    inverse_of_upper(const VoigtMatrix<dim> &upper)
    {
      constexpr unsigned int n = n_stress_components<dim>;
      VoigtMatrix<dim>       result;
      for (unsigned int j = 0; j < n; ++j)
        for (unsigned int i = j + 1; i-- > 0;)
          {
            double value = i == j ? 1. : 0.;
            for (unsigned int k = i + 1; k <= j; ++k)
              value -= upper[i][k] * result[k][j];
            result[i][j] = value / upper[i][i];
          }
      return result;
    }

    using Matrices = PointValues<VoigtMatrix<dim>>;

    void
    transform(const bool to_strain, const Vector &source, Vector &target) const
    {
      using Field                           = QuadratureField<dim>;
      const std::vector<Matrices> &matrices = to_strain ? inverses : roots;
      target.reinit(source, true);
      std::size_t offset = 0;
      for (std::size_t point = 0; point < weights.size(); ++point)
        for (const Matrices &of_branch : matrices)
          {
            const double weight = weights[point];
            Field::set(target,
                       offset,
                       (to_strain ? 1. / weight : weight) *
                         (of_branch[point] * Field::get(source, offset)));
            offset += Field::n_components;
          }
    }

    std::vector<double> weights; ///< √(det J × weight) of each point
    // Matrices of each branch
    std::vector<Matrices> roots;    ///< roots Lᵀ, ηᵢ / T = L Lᵀ
    std::vector<Matrices> inverses; ///< inverse roots L⁻ᵀ
  };
} // namespace Crevasse

#endif
