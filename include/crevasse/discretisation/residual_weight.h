// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_discretisation_residual_weight_h
#define crevasse_discretisation_residual_weight_h

#include <crevasse/material/voigt_matrix.h>

#include <memory>

namespace Crevasse
{
  /**
   * Weight of the residual of equilibrium in a cell for the energy of the error
   * that it causes: a compliance c (1/stress), times the square of the
   * residual where the cell is isotropic.
   *
   * An anisotropic body gives way to a traction t on a face with the normal n
   * by its acoustic tensor Γ(n) = n·C·n, with the energy t·Γ⁻¹t, and to a
   * force by the sum of Γ over all axes. Both count relative to the isotropic
   * body with the mean compliances, of which c is. With c alone, a norm of the
   * compliance, residuals along stiff fibres would count as if across.
   */
  template <int dim>
  class ResidualWeight
  {
  public:
    /** Weight of an isotropic cell. */
    explicit ResidualWeight(const double compliance)
      : compliance(compliance)
    {
    }

    /** Weight of a cell with any stiffness. */
    ResidualWeight(const double compliance, const VoigtMatrix<dim> &stiffness)
      : compliance(compliance)
      , body(std::make_shared<const Anisotropic>(stiffness))
    {
    }

    /** Weighted square of a traction. */
    double
    of_traction(const dealii::Tensor<1, dim> &traction,
                const dealii::Tensor<1, dim> &normal) const
    {
      if (body == nullptr)
        return compliance * traction.norm_square();
      const dealii::Tensor<1, dim> across = (traction * normal) * normal;
      const dealii::Tensor<1, dim> scaled =
        std::sqrt(body->mu) * (traction - across) +
        std::sqrt(body->tension) * across;
      return compliance * (scaled * (invert(body->acoustic(normal)) * scaled));
    }

    /** Weighted square of a force in the volume. */
    double
    of_force(const dealii::Tensor<1, dim> &force) const
    {
      return compliance * (body == nullptr ? force.norm_square()
                                           : force * (body->of_axes * force));
    }

  private:
    struct Anisotropic
    {
      explicit Anisotropic(const VoigtMatrix<dim> &stiffness)
        : stiffness(stiffness)
      {
        const VoigtMatrix<dim> S =
          inverse<dim>(dim == 2 ? in_plane<dim>(stiffness) : stiffness);
        double sum = 0., trace = 0.;
        for (unsigned int i = 0; i < n_stress_components<dim>; ++i)
          {
            trace += (i < 3 ? 1. : 0.5) * S[i][i];
            for (unsigned int j = 0; i < dim && j < dim; ++j)
              sum += S[i][j];
          }
        mu      = (0.25 * dim * (dim + 1) - 0.5) / (trace - sum / dim);
        tension = 1. / sum + 2. * mu * (1. - 1. / dim);
        dealii::Tensor<2, dim> all;
        for (unsigned int d = 0; d < dim; ++d)
          {
            dealii::Tensor<1, dim> axis;
            axis[d] = 1.;
            all += acoustic(axis);
          }
        of_axes = (tension + (dim - 1.) * mu) * invert(all);
      }

      dealii::Tensor<2, dim>
      acoustic(const dealii::Tensor<1, dim> &normal) const
      {
        dealii::Tensor<2, dim> all;
        for (unsigned int i = 0; i < dim; ++i)
          for (unsigned int k = 0; k < dim; ++k)
            for (unsigned int j = 0; j < dim; ++j)
              for (unsigned int l = 0; l < dim; ++l)
                all[i][k] +=
                  normal[j] * normal[l] *
                  stiffness[voigt_index<dim>(i, j)][voigt_index<dim>(k, l)];
        return all;
      }

      const VoigtMatrix<dim> stiffness;
      double                 mu, tension; ///< μ and λ + 2μ of the mean
      dealii::Tensor<2, dim> of_axes;     ///< (Σ Γ)⁻¹ relative to the mean
    };

    double                             compliance;
    std::shared_ptr<const Anisotropic> body; ///< null: isotropic
  };
} // namespace Crevasse

#endif
