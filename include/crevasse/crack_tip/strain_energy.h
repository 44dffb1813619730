// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_crack_tip_strain_energy_h
#define crevasse_crack_tip_strain_energy_h

#include <crevasse/crack_tip/tip_region.h>
#include <crevasse/discretisation/material_field.h>
#include <crevasse/material/voigt_matrix.h>

namespace Crevasse
{
  /**
   * Energy in the springs of the material in the modelled part of the body
   * (half of it above a crack), per thickness:
   *
   *     ½ ∫ s:(kK)⁻¹s  for one Maxwell body or an elastic one,
   *     ½ ∫ Σ wᵢ εᵢ:kK εᵢ,   εᵢ = (kK)⁻¹s + Σ wⱼrⱼ − rᵢ  for a chain,
   *
   * where the spring of a chain has r = 0. It is the work minus the
   * dissipation.
   */
  class StrainEnergy
  {
  public:
    /** Collective. The arguments must outlive the StrainEnergy. */
    StrainEnergy(const MaterialField<2> &material, const PointGeometry &points)
      : points(points)
      , constant_compliance(
          material.stiffness_varies
            ? std::nullopt
            : std::make_optional(compliance_of(material.at(0.))))
    {
    }

    /** Computes the energy. Collective. @param state at the instant. */
    double
    value(const MaterialState<2> &state,
          const Vector           &stress,
          const Vector           &viscous_strain) const
    {
      using Field = QuadratureField<2>;
      std::optional<Matrices> of_now;
      if (!constant_compliance)
        of_now = compliance_of(state);
      const Matrices &compliance = of_now ? *of_now : *constant_compliance;

      const unsigned int n_branches = state.fractions.size();
      const double       k          = state.stiffness_factor;
      const bool         is_chain   = n_branches > 0 &&
                            (state.spring != 0. || n_branches > 1) &&
                            viscous_strain.size() > 0;
      double twofold = 0.;
      for (std::size_t p = 0; p < points.weight.size(); ++p)
        {
          const std::size_t    offset      = p * Field::n_components;
          const VoigtVector<2> s           = Field::get(stress, offset);
          VoigtVector<2>       mean_strain = compliance[p] * s / k;
          if (!is_chain)
            {
              twofold += points.weight[p] * (s * mean_strain);
              continue;
            }
          const auto r = [&](const unsigned int i) {
            return Field::get(viscous_strain,
                              offset * n_branches + i * Field::n_components);
          };
          for (unsigned int i = 0; i < n_branches; ++i)
            mean_strain += state.fractions[i] * r(i);
          const VoigtMatrix<2> kK = k * (*state.stiffness)[p];
          double density = state.spring * (mean_strain * (kK * mean_strain));
          for (unsigned int i = 0; i < n_branches; ++i)
            {
              const VoigtVector<2> strain = mean_strain - r(i);
              density += state.fractions[i] * (strain * (kK * strain));
            }
          twofold += points.weight[p] * density;
        }
      return 0.5 * dealii::Utilities::MPI::sum(twofold,
                                               stress.get_mpi_communicator());
    }

  private:
    using Matrices = PointValues<VoigtMatrix<2>>;

    Matrices
    compliance_of(const MaterialState<2> &state) const
    {
      return transform(*state.stiffness, points.location.size(), inverse<2>);
    }

    const PointGeometry          &points;
    const std::optional<Matrices> constant_compliance; ///< constant compliance
  };
} // namespace Crevasse

#endif
