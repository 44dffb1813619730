// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/text.h>
#include <crevasse/material/maxwell_law.h>
#include <crevasse/material/properties.h>
#include <crevasse/parameters/chain.h>

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
      if (parameters.viscosity == "relaxation time")
        branches.push_back(
          {1.,
           proportional_fluidity<dim>(
             parameters, "Relaxation time", parameters.relaxation_time, 1.)});
      else if (parameters.viscosity == "isotropic")
        branches.push_back({1., isotropic_fluidity<dim>(parameters)});
      else if (parameters.viscosity == "matrix")
        branches.push_back({1., fluidity_of_matrix<dim>(parameters)});
      else if (parameters.viscosity == "chain")
        for (const ChainBranch &branch : parse_chain(parameters.chain))
          branches.push_back({branch.fraction,
                              proportional_fluidity<dim>(parameters,
                                                         "Chain",
                                                         branch.relaxation_time,
                                                         branch.fraction)});
      return branches;
    }



    Expression
    time_factor(const char *name, const std::string &formula)
    {
      return Expression(formula,
                        Expression::Variables::space_and_time,
                        Text::parameter(MaterialParameters::section, name));
    }
  } // namespace



  template <int dim>
  MaxwellLaw<dim>::MaxwellLaw(const MaterialParameters &parameters)
    : K(stiffness_property<dim>(parameters))
    , maxwell_branches(make_branches<dim>(parameters))
    , expansion(thermal_expansion_property<dim>(parameters))
    , plane_stress(dim == 2 && parameters.plane_state == "plane stress")
    , k(time_factor("Stiffness time factor", parameters.stiffness_time_factor))
    , eta_0(
        time_factor("Viscosity time factor", parameters.viscosity_time_factor))
  {
    if (parameters.viscosity != "relaxation time")
      return;
    const Expression tau(parameters.relaxation_time,
                         Expression::Variables::space_time_and_material);
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
