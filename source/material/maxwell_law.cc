// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/material/maxwell_law.h>
#include <crevasse/material/properties.h>

namespace Crevasse
{
  namespace
  {
    template <int dim>
    std::vector<typename MaxwellLaw<dim>::Branch>
    make_branches(const MaterialParameters &parameters)
    {
      using Branch = typename MaxwellLaw<dim>::Branch;
      std::vector<Branch> branches;
      switch (parameters.viscosity)
        {
          case ViscosityType::relaxation_time:
            branches.push_back(
              {1.,
               proportional_fluidity<dim>(parameters,
                                          *parameters.relaxation_time,
                                          1.)});
            break;
          case ViscosityType::isotropic:
            branches.push_back({1., isotropic_fluidity<dim>(parameters)});
            break;
          case ViscosityType::matrix:
            branches.push_back({1., fluidity_of_matrix<dim>(parameters)});
            break;
          case ViscosityType::chain:
            for (const ChainBranch &branch : *parameters.chain)
              branches.push_back(
                {branch.fraction,
                 proportional_fluidity<dim>(parameters,
                                            branch.relaxation_time,
                                            branch.fraction)});
            break;
          case ViscosityType::none:
            break;
        }
      return branches;
    }
  } // namespace



  template <int dim>
  MaxwellLaw<dim>::MaxwellLaw(const MaterialParameters &parameters)
    : K(stiffness_property<dim>(parameters))
    , maxwell_branches(make_branches<dim>(parameters))
    , plane_stress(dim == 2 &&
                   parameters.plane_state == PlaneState::plane_stress)
    , k(*parameters.stiffness_time_factor)
    , eta_0(*parameters.viscosity_time_factor)
  {
    for (const auto &strain : parameters.free_strains())
      strains.push_back(
        {strain_property<dim>(strain.components), strain.is_thermal});
    if (parameters.viscosity != ViscosityType::relaxation_time)
      return;
    const Expression &tau  = *parameters.relaxation_time;
    const bool has_factors = !k.is_constant() || k.value(Place<dim>()) != 1. ||
                             !eta_0.is_constant() ||
                             eta_0.value(Place<dim>()) != 1.;
    if (!has_factors && tau.is_constant())
      uniform_tau = tau.value(Place<dim>());
  }



  template <int dim>
  bool
  MaxwellLaw<dim>::has_spring() const
  {
    double creeping = 0.;
    for (const Branch &branch : maxwell_branches)
      creeping += branch.fraction;
    constexpr double rounding = 1e-12;
    return creeping < 1. - rounding;
  }



  template class MaxwellLaw<2>;
  template class MaxwellLaw<3>;
} // namespace Crevasse
