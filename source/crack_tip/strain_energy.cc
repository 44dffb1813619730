// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/crack_tip/strain_energy.h>
#include <crevasse/material/voigt_matrix.h>

#include <deal.II/base/mpi.h>

namespace Crevasse
{
  using namespace dealii;

  StrainEnergy::StrainEnergy(const MaterialField<2> &material,
                             const PointGeometry    &points)
    : material(material)
    , points(points)
  {
    if (!material.stiffness_varies())
      constant_compliance = std::make_unique<const Matrices>(
        compliance_of(*material.at(0.).stiffness));
  }



  StrainEnergy::Matrices
  StrainEnergy::compliance_of(const Matrices &stiffness) const
  {
    return transform(stiffness,
                     points.location.size(),
                     [](const VoigtMatrix<2> &K) { return inverse<2>(K); });
  }



  double
  StrainEnergy::density(const MaterialState<2> &state,
                        const Matrices         &compliance,
                        const std::size_t       point,
                        const Vector           &stress,
                        const Vector           &viscous_strain) const
  {
    using Field                      = QuadratureField<2>;
    const std::size_t    offset      = point * Field::n_components;
    const VoigtVector<2> s           = Field::get(stress, offset);
    const unsigned int   n_branches  = state.fractions.size();
    const double         k           = state.stiffness_factor;
    const bool           is_chain    = state.spring != 0. || n_branches > 1;
    VoigtVector<2>       mean_strain = compliance[point] * s / k;
    if (n_branches == 0 || !is_chain || viscous_strain.size() == 0)
      return 0.5 * (s * mean_strain);

    const auto r = [&](const unsigned int i) {
      return Field::get(viscous_strain,
                        offset * n_branches + i * Field::n_components);
    };
    for (unsigned int i = 0; i < n_branches; ++i)
      mean_strain += state.fractions[i] * r(i);
    const VoigtMatrix<2> &K = (*state.stiffness)[point];
    double twofold          = state.spring * (mean_strain * (K * mean_strain));
    for (unsigned int i = 0; i < n_branches; ++i)
      {
        const VoigtVector<2> strain = mean_strain - r(i);
        twofold += state.fractions[i] * (strain * (K * strain));
      }
    return 0.5 * k * twofold;
  }



  double
  StrainEnergy::value(const double  t,
                      const Vector &stress,
                      const Vector &viscous_strain) const
  {
    const MaterialState<2>          state = material.at(t);
    std::unique_ptr<const Matrices> of_now;
    if (constant_compliance == nullptr)
      of_now =
        std::make_unique<const Matrices>(compliance_of(*state.stiffness));
    const Matrices &compliance = of_now ? *of_now : *constant_compliance;

    double energy = 0.;
    for (std::size_t p = 0; p < points.weight.size(); ++p)
      energy += points.weight[p] *
                density(state, compliance, p, stress, viscous_strain);
    return Utilities::MPI::sum(energy, stress.get_mpi_communicator());
  }
} // namespace Crevasse
