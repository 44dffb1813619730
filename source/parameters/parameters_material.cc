// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/range.h>
#include <crevasse/parameters/checker.h>
#include <crevasse/parameters/parameters.h>

#include <algorithm>

namespace Crevasse
{
  using namespace dealii;

  void
  MaterialParameters::add_parameters(ParameterHandler &prm)
  {
    add_selection("Plane state", plane_state, prm);
    // The same of all coefficients.
    const std::string formula =
      " or a formula of x, y, z, t, theta, material with such values";

    young_modulus.add_parameter(
      "Young modulus",
      "Young's modulus of the elastic strain, in units of "
      "stress. Allowed: a number greater than 0" +
        formula,
      prm);
    poisson_ratio.add_parameter(
      "Poisson ratio",
      "Poisson's ratio of the elastic strain. Allowed: a "
      "number of at least -0.999, less than 0.5" +
        formula,
      prm);
    const std::string matrix =
      "a symmetric matrix of numbers or formulas, its rows separated by "
      "semicolons and the entries of a row by commas. Components: 11, 22, 12 "
      "(plane stress), 11, 22, 33, 12 (plane stress or strain), 11, 22, 33, "
      "12, 13, 23 (three dimensions), with engineering shear strains";
    stiffness_matrix.add_parameter(
      "Stiffness matrix",
      "Stiffness, in units of stress, instead of Young modulus "
      "and Poisson ratio. Allowed: nothing, or " +
        matrix,
      prm);
    stiffness_time_factor.add_parameter(
      "Stiffness time factor",
      "Factor of the stiffness, the same everywhere: ageing "
      "that costs no other factorisation. The viscosity does "
      "not follow it. Allowed: a formula of t with values "
      "greater than 0",
      prm);
    add_selection("Viscosity", viscosity, prm);
    relaxation_time.add_parameter(
      "Relaxation time",
      "Viscosity divided by stiffness, in units of time; used "
      "by the viscosity \"relaxation time\". Allowed: a number "
      "greater than 0" +
        formula,
      prm);
    viscous_modulus.add_parameter(
      "Viscous modulus",
      "Stress per rate of viscous strain under tension, in "
      "units of stress times time; used by the viscosity "
      "\"isotropic\". Allowed: a number greater than 0" +
        formula,
      prm);
    viscous_poisson_ratio.add_parameter(
      "Viscous Poisson ratio",
      "Ratio of lateral to axial viscous strain under tension; "
      "0.5 keeps the volume. Used by the viscosity "
      "\"isotropic\". Allowed: a number of at least -0.999, at "
      "most 0.5" +
        formula,
      prm);
    viscosity_matrix.add_parameter(
      "Viscosity matrix",
      "Viscosity, in units of stress times time; used by the "
      "viscosity \"matrix\". Allowed: " +
        matrix,
      prm);
    viscosity_time_factor.add_parameter(
      "Viscosity time factor",
      "Factor of the viscosity, the same everywhere. Allowed: "
      "a formula of t with values greater than 0",
      prm);
    chain.add_parameter(
      "Chain",
      "Maxwell bodies in parallel, for the viscosity \"chain\": the fraction "
      "of the stiffness that each has, and its relaxation time in units of "
      "time. What is left of the stiffness is an elastic spring beside them. "
      "Allowed: a list such "
      "as 0.5: 10; 0.3: 100, fractions greater than 0 with a sum of at most "
      "1, relaxation times greater than 0" +
        formula,
      prm);
    thermal_expansion.add_parameter(
      "Thermal expansion",
      "Strain per change of temperature, in units of 1 / "
      "temperature: one value for "
      "isotropic expansion, or the components 11, 22, 12 (33 "
      "is that of 11), or 11, 22, 33, 12, or 11, 22, 33, 12, "
      "13, 23 of the tensor, separated by commas. Allowed: a "
      "number" +
        formula,
      prm);
  }



  namespace
  {
    /** A number must lie in its range; of a formula this is known when there
     * are points. */
    bool
    may_lie_in(const Range &range, const Expression &coefficient)
    {
      return !coefficient.is_constant() ||
             range.contains(coefficient.value(Place<2>()));
    }



    void
    check_coefficient(const char    *name,
                      const Formula &formula,
                      const Range   &range,
                      const Checker &checker)
    {
      checker.demand_valid(name, formula);
      checker.demand(!formula.is_valid() || may_lie_in(range, *formula),
                     name,
                     formula.text(),
                     range.text);
    }



    /** The entries of a matrix or tensor. Their number is that of a dimension,
     * which the scene knows. */
    void
    check_entries(const char                    *name,
                  const std::string             &value,
                  const std::vector<Expression> &entries,
                  const Checker                 &checker)
    {
      const Range &range = Ranges::any_number;
      checker.demand(std::all_of(entries.begin(),
                                 entries.end(),
                                 [&range](const Expression &entry) {
                                   return may_lie_in(range, entry);
                                 }),
                     name,
                     value,
                     "every entry " + std::string(range.text));
    }



    void
    check_matrix(const char          *name,
                 const FormulaMatrix &matrix,
                 const Checker       &checker)
    {
      checker.demand_valid(name, matrix);
      if (matrix.is_valid())
        check_entries(name, matrix.text(), entries(matrix), checker);
    }



    /** A factor k(t) > 0. */
    void
    check_time_factor(const char    *name,
                      const Formula &factor,
                      const Checker &checker)
    {
      check_coefficient(name, factor, Ranges::positive, checker);
      if (factor.is_valid())
        for (const char *variable : {"x", "y", "z", "theta", "material"})
          checker.demand(!factor->depends_on(variable),
                         name,
                         factor.text(),
                         std::string("must not depend on ") + variable +
                           "; only t is the same everywhere");
    }
  } // namespace



  std::vector<MaterialParameters::FreeStrain>
  MaterialParameters::free_strains() const
  {
    return {
      {"Thermal expansion", "thermal strain", thermal_expansion, true},
    };
  }



  void
  MaterialParameters::check(Problems &problems) const
  {
    const Checker checker(section, problems);
    const auto    check =
      [&](const char *name, const Formula &formula, const Range &range) {
        check_coefficient(name, formula, range, checker);
      };

    if (stiffness_matrix.text().empty())
      {
        check("Young modulus", young_modulus, Ranges::positive);
        check("Poisson ratio", poisson_ratio, Ranges::elastic_ratio);
      }
    else
      check_matrix("Stiffness matrix", stiffness_matrix, checker);
    check_time_factor("Stiffness time factor", stiffness_time_factor, checker);
    check_time_factor("Viscosity time factor", viscosity_time_factor, checker);
    for (const FreeStrain &strain : free_strains())
      {
        const Formulas &components = strain.components;
        checker.demand_valid(strain.parameter, components);
        if (components.is_valid())
          check_entries(strain.parameter,
                        components.text(),
                        *components,
                        checker);
      }

    switch (viscosity)
      {
        case ViscosityType::relaxation_time:
          check("Relaxation time", relaxation_time, Ranges::positive);
          break;
        case ViscosityType::isotropic:
          check("Viscous modulus", viscous_modulus, Ranges::positive);
          check("Viscous Poisson ratio",
                viscous_poisson_ratio,
                Ranges::viscous_ratio);
          break;
        case ViscosityType::matrix:
          checker.demand(!viscosity_matrix.text().empty(),
                         "Viscosity matrix",
                         viscosity_matrix.text(),
                         "must be given, for the viscosity is \"matrix\": a "
                         "list such as 9, 2, 0; 2, 9, 0; 0, 0, 3 (plane "
                         "stress), its rows separated by semicolons");
          check_matrix("Viscosity matrix", viscosity_matrix, checker);
          break;
        case ViscosityType::chain:
          checker.demand_valid("Chain", chain);
          if (chain.is_valid())
            for (const ChainBranch &branch : *chain)
              checker.demand(may_lie_in(Ranges::positive,
                                        branch.relaxation_time),
                             "Chain",
                             branch.relaxation_time.formula(),
                             Ranges::positive.text);
          break;
        case ViscosityType::none:
          break;
      }
  }
} // namespace Crevasse
