// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_periodic_return_defect_h
#define crevasse_periodic_return_defect_h

#include <crevasse/contact/signorini_problem.h>
#include <crevasse/discretisation/material_field.h>
#include <crevasse/periodic/contraction.h>
#include <crevasse/time/state.h>

namespace Crevasse
{
  /**
   * Change of the viscous strain over a period, as an error of the stress. With
   * η ṙ = s,
   *
   *     r(T) − r(0) = T η⁻¹ s̄,
   *
   * so an error δs̄ of the mean stress changes r by T η⁻¹ δs̄ (besides T α, if
   * there is a secular flow). Conversely δs̄ is at most K times this change
   * times τ/T, replaced by 1/(1−exp(−T/τ)). If a lip is closed for a tenth of
   * the period, the error of its pressure is ten times δs̄. Unlike the change of
   * stress, the defect does not vanish where a body creeps without stress until
   * the lip closes.
   */
  template <int dim>
  struct ReturnDefect
  {
    /** Largest component of δs̄ at all points, relative to @p largest_stress; 0
     * if it is rounding. Collective. */
    double
    operator()(const Vector &before,
               const Vector &after,
               const double  largest_stress) const
    {
      using Field               = QuadratureField<dim>;
      constexpr double rounding = 1e-12, resolved = 10.;
      // Largest stress of the change and of the strain; error of the mean.
      double      largest[3] = {};
      std::size_t offset     = 0;
      for (std::size_t point = 0; point < n_points; ++point)
        for (unsigned int i = 0; i < material.fractions.size(); ++i)
          {
            const VoigtMatrix<dim> K = material.stiffness_factor *
                                       material.fractions[i] *
                                       (*material.stiffness)[point];
            const VoigtVector<dim> strain = Field::get(after, offset);
            VoigtVector<dim>       left   = strain - Field::get(before, offset);
            if (flow != nullptr && !is_split)
              left -= period * Field::get(flow->strain_rate, offset);
            const VoigtVector<dim> stress = K * left;
            const double           size   = largest_entry(stress);
            const double           relaxed =
              largest_entry(K * ((*material.fluidity[i])[point] * stress)) *
              period * mean_fluidity_factor;
            largest[1] = std::max(largest[1], largest_entry(K * strain));
            if (size > 0.)
              {
                // Rounding of the mean stress changes r by T/τ times as much.
                const double rate = relaxed / size;
                largest[0] = std::max(largest[0], size / std::max(1., rate));
                largest[2] =
                  std::max(largest[2], size * slowness_of_relaxation(rate));
              }
            offset += Field::n_components;
          }
      dealii::Utilities::MPI::max(largest,
                                  before.get_mpi_communicator(),
                                  largest);
      if (largest[0] <= rounding * std::max(largest_stress, largest[1]))
        return 0.;
      return resolved * largest[2] / largest_stress;
    }

    /** Whether the whole lip is open and opens further from @p before to @p
     * after, a period later. Then strain without stress brings no contact
     * nearer, and strain with stress shows in the change of stress. False with
     * an elastic spring, in which all strain causes stress. Collective. */
    bool
    lip_opens(const Vector &before, const Vector &after) const
    {
      constexpr double rounding = 1e-10;
      if (material.spring > rounding)
        return false;
      const double small = rounding * after.linfty_norm();
      bool         opens = true;
      for (unsigned int k = 0; k < bounds.dofs.size(); ++k)
        {
          const auto dof  = bounds.dofs[k];
          double     gain = after(dof) - before(dof);
          if (flow != nullptr && is_split)
            gain += period * flow->velocity(dof);
          opens = opens && bounds.sign[k] * gain >= -small &&
                  bounds.sign[k] * after(dof) - bounds.gap[k] > small;
        }
      return dealii::Utilities::MPI::min(opens ? 1 : 0,
                                         after.get_mpi_communicator()) == 1;
    }

    const std::size_t n_points; ///< quadrature points of this rank
    /** Material that converts strain to stress, at one instant. */
    const MaterialState<dim> &material;
    const SecularFlow        *flow;     ///< secular flow; null: none
    const bool                is_split; ///< whether the strain lacks the flow
    /** Mean of 1/η₀ over the period, instead of that of the instant: the strain
     * flows during the whole period. */
    const double            mean_fluidity_factor;
    const double            period;
    const UnilateralBounds &bounds; ///< contact bounds of the lip

  private:
    template <int n>
    static double
    largest_entry(const dealii::Tensor<1, n> &values)
    {
      double largest = 0.;
      for (unsigned int i = 0; i < n; ++i)
        largest = std::max(largest, std::abs(values[i]));
      return largest;
    }
  };
} // namespace Crevasse

#endif
