// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/text.h>
#include <crevasse/parameters/chain.h>
#include <crevasse/parameters/coefficients.h>
#include <crevasse/temperature/temperature.h>

#include <algorithm>
#include <iterator>

namespace Crevasse
{
  Formulas
  stiffness_formulas(const MaterialParameters &material)
  {
    if (!material.stiffness_matrix.empty())
      return {{"Stiffness matrix", material.stiffness_matrix}};
    return {{"Young modulus", material.young_modulus},
            {"Poisson ratio", material.poisson_ratio}};
  }



  Formulas
  viscosity_formulas(const MaterialParameters &material)
  {
    if (material.viscosity == "none")
      return {};
    if (material.viscosity == "isotropic")
      return {{"Viscous modulus", material.viscous_modulus},
              {"Viscous Poisson ratio", material.viscous_poisson_ratio}};
    if (material.viscosity == "matrix")
      return {{"Viscosity matrix", material.viscosity_matrix}};
    Formulas formulas = stiffness_formulas(material);
    if (material.viscosity == "chain")
      for (const ChainBranch &branch : parse_chain(material.chain))
        formulas.emplace_back("Chain", branch.relaxation_time);
    else
      formulas.emplace_back("Relaxation time", material.relaxation_time);
    return formulas;
  }



  std::vector<Expression>
  parse_coefficients(const std::string &formulas)
  {
    std::vector<Expression> all;
    for (const std::string &row : Text::split(formulas, ';'))
      {
        std::vector<Expression> entries =
          Expression::parse_row(row,
                                Expression::Variables::space_time_and_material);
        std::move(entries.begin(), entries.end(), std::back_inserter(all));
      }
    return all;
  }



  bool
  are_zero(const std::vector<Expression> &formulas)
  {
    return std::all_of(formulas.begin(),
                       formulas.end(),
                       [](const Expression &formula) {
                         return formula.is_zero();
                       });
  }



  bool
  expands(const MaterialParameters &material)
  {
    return !are_zero(parse_coefficients(material.thermal_expansion));
  }



  bool
  is_warm(const LoadParameters &loads)
  {
    return Temperature<2>::is_file(loads.temperature) ||
           !Expression(loads.temperature).is_zero();
  }
} // namespace Crevasse
