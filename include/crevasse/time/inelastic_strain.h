// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_time_inelastic_strain_h
#define crevasse_time_inelastic_strain_h

#include <crevasse/discretisation/material_field.h>

namespace Crevasse
{
  /** Viscous and free strains at the quadrature points. */
  template <int dim>
  class InelasticStrain
  {
  public:
    using Field                     = QuadratureField<dim>;
    static constexpr unsigned int n = Field::n_components;

    /** @param r viscous strain, empty if there is none.
     * @param base strain from which r counts, or null. */
    InelasticStrain(const MaterialState<dim> &material,
                    const Vector             &r,
                    const Vector             *base = nullptr)
      : material(material)
      , r(r)
      , base(base)
      , n_branches(r.size() == 0 ? 0 : material.fluidity.size())
    {
    }

    std::size_t
    place(const std::size_t offset, const unsigned int i) const
    {
      return offset * n_branches + i * n;
    }

    /** rᵢ of the point and branch whose strain is at offset @p place. */
    VoigtVector<dim>
    viscous(const std::size_t place) const
    {
      return base == nullptr ? Field::get(r, place)
                             : Field::get(r, place) + Field::get(*base, place);
    }

    /** Strain without stress besides creep: χθ − ε(q), where q are the imposed
     * displacements. */
    VoigtVector<dim>
    free(const std::size_t offset) const
    {
      return material.free_strain == nullptr
               ? VoigtVector<dim>()
               : (*material.free_strain)[offset / n];
    }

    /** Viscous strain rᵢ of branch @p i. */
    VoigtVector<dim>
    branch(const std::size_t offset, const unsigned int i) const
    {
      const VoigtVector<dim> state = viscous(place(offset, i));
      return material.hardens ? (*material.creep)[offset / n].strain(state)
                              : state;
    }

    /** Inelastic strain Σ wᵢ rᵢ + χθ − ε(q). */
    VoigtVector<dim>
    operator()(const std::size_t offset) const
    {
      VoigtVector<dim> strain = free(offset);
      for (unsigned int i = 0; i < n_branches; ++i)
        strain += material.fractions[i] * branch(offset, i);
      return strain;
    }

    const MaterialState<dim> &material;
    const Vector             &r;
    const Vector             *base;
    const unsigned int        n_branches;
  };
} // namespace Crevasse

#endif
