// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/expression.h>
#include <crevasse/base/range.h>
#include <crevasse/base/text.h>
#include <crevasse/parameters/chain.h>
#include <crevasse/parameters/checker.h>
#include <crevasse/parameters/parameters.h>

#include <deal.II/base/patterns.h>

namespace Crevasse
{
  using namespace dealii;

  void
  MaterialParameters::add_parameters(ParameterHandler &prm)
  {
    prm.add_parameter("Plane state",
                      plane_state,
                      "What a plane model assumes of the third direction; "
                      "without meaning in three dimensions.",
                      Patterns::Selection("plane stress|plane strain"));
    // The same of all coefficients.
    const std::string formula =
      " or a formula of x, y, z, t, theta, material with such values";

    prm.add_parameter("Young modulus",
                      young_modulus,
                      "Young's modulus of the elastic strain, in units of "
                      "stress. Allowed: a number greater than 0" +
                        formula);
    prm.add_parameter("Poisson ratio",
                      poisson_ratio,
                      "Poisson's ratio of the elastic strain. Allowed: a "
                      "number of at least -0.999, less than 0.5" +
                        formula);
    const std::string matrix =
      "a symmetric matrix of numbers or formulas, its rows separated by "
      "semicolons and the entries of a row by commas. Components: 11, 22, 12 "
      "(plane stress), 11, 22, 33, 12 (plane stress or strain), 11, 22, 33, "
      "12, 13, 23 (three dimensions), with engineering shear strains";
    prm.add_parameter("Stiffness matrix",
                      stiffness_matrix,
                      "Stiffness, in units of stress, instead of Young modulus "
                      "and Poisson ratio. Allowed: nothing, or " +
                        matrix);
    prm.add_parameter("Stiffness time factor",
                      stiffness_time_factor,
                      "Factor of the stiffness, the same everywhere: ageing "
                      "that costs no other factorisation. The viscosity does "
                      "not follow it. Allowed: a formula of t with values "
                      "greater than 0");
    prm.add_parameter(
      "Viscosity",
      viscosity,
      "How the body creeps: \"relaxation time\" makes the viscosity the "
      "stiffness (without its time factor) times Relaxation time; "
      "\"isotropic\" builds it from Viscous modulus and Viscous Poisson ratio; "
      "\"matrix\" is Viscosity matrix; \"chain\" puts several such bodies in "
      "parallel; \"none\" is an elastic body.",
      Patterns::Selection("relaxation time|isotropic|matrix|chain|none"));
    prm.add_parameter("Relaxation time",
                      relaxation_time,
                      "Viscosity divided by stiffness, in units of time; used "
                      "by the viscosity \"relaxation time\". Allowed: a number "
                      "greater than 0" +
                        formula);
    prm.add_parameter("Viscous modulus",
                      viscous_modulus,
                      "Stress per rate of viscous strain under tension, in "
                      "units of stress times time; used by the viscosity "
                      "\"isotropic\". Allowed: a number greater than 0" +
                        formula);
    prm.add_parameter("Viscous Poisson ratio",
                      viscous_poisson_ratio,
                      "Ratio of lateral to axial viscous strain under tension; "
                      "0.5 keeps the volume. Used by the viscosity "
                      "\"isotropic\". Allowed: a number of at least -0.999, at "
                      "most 0.5" +
                        formula);
    prm.add_parameter("Viscosity matrix",
                      viscosity_matrix,
                      "Viscosity, in units of stress times time; used by the "
                      "viscosity \"matrix\". Allowed: " +
                        matrix);
    prm.add_parameter("Viscosity time factor",
                      viscosity_time_factor,
                      "Factor of the viscosity, the same everywhere. Allowed: "
                      "a formula of t with values greater than 0");
    prm.add_parameter(
      "Chain",
      chain,
      "Maxwell bodies in parallel, for the viscosity \"chain\": the fraction "
      "of the stiffness that each has, and its relaxation time in units of "
      "time. What is left of the stiffness is an elastic spring beside them. "
      "Allowed: a list such "
      "as 0.5: 10; 0.3: 100, fractions greater than 0 with a sum of at most "
      "1, relaxation times greater than 0" +
        formula);
    prm.add_parameter("Thermal expansion",
                      thermal_expansion,
                      "Strain per change of temperature, in units of 1 / "
                      "temperature: one value for "
                      "isotropic expansion, or the components 11, 22, 12 (33 "
                      "is that of 11), or 11, 22, 33, 12, or 11, 22, 33, 12, "
                      "13, 23 of the tensor, separated by commas. Allowed: a "
                      "number" +
                        formula);
  }



  namespace
  {
    constexpr auto variables = Expression::Variables::space_time_and_material;



    /** A number must lie in its range; of a formula this is known when there
     * are points. */
    bool
    may_lie_in(const Range &range, const Expression &coefficient)
    {
      return !coefficient.is_constant() ||
             range.contains(coefficient.value(Place<2>()));
    }



    /** A coefficient of the material must be a formula. */
    void
    check_coefficient(const char        *name,
                      const std::string &formula,
                      const Range       &range,
                      const Checker     &checker)
    {
      checker.demand_readable(name, formula, [&]() {
        checker.demand(may_lie_in(range, Expression(formula, variables)),
                       name,
                       formula,
                       range.text);
      });
    }



    /** The entries of a matrix or tensor. Their number is that of a dimension,
     * which the scene knows. */
    void
    check_entries(const char        *name,
                  const std::string &value,
                  const Checker     &checker)
    {
      const Range &range = Ranges::any_number;
      checker.demand_readable(name, value, [&]() {
        bool fulfilled = true;
        for (const std::string &row : Text::split(value, ';'))
          for (const Expression &entry : Expression::parse_row(row, variables))
            fulfilled = fulfilled && may_lie_in(range, entry);
        checker.demand(fulfilled,
                       name,
                       value,
                       "every entry " + std::string(range.text));
      });
    }



    /** A factor k(t) > 0. */
    void
    check_time_factor(const char        *name,
                      const std::string &formula,
                      const Checker     &checker)
    {
      checker.demand_readable(name, formula, [&]() {
        const Expression factor(formula, variables);
        checker.demand(may_lie_in(Ranges::positive, factor),
                       name,
                       formula,
                       Ranges::positive.text);
        for (const char *variable : {"x", "y", "z", "theta", "material"})
          checker.demand(!factor.depends_on(variable),
                         name,
                         formula,
                         std::string("must not depend on ") + variable +
                           "; only t is the same everywhere");
      });
    }
  } // namespace



  void
  MaterialParameters::check(Problems &problems) const
  {
    const Checker checker(section, problems);
    const auto    check =
      [&](const char *name, const std::string &formula, const Range &range) {
        check_coefficient(name, formula, range, checker);
      };

    if (stiffness_matrix.empty())
      {
        check("Young modulus", young_modulus, Ranges::positive);
        check("Poisson ratio", poisson_ratio, Ranges::elastic_ratio);
      }
    else
      check_entries("Stiffness matrix", stiffness_matrix, checker);
    check_time_factor("Stiffness time factor", stiffness_time_factor, checker);
    check_time_factor("Viscosity time factor", viscosity_time_factor, checker);
    check_entries("Thermal expansion", thermal_expansion, checker);

    if (viscosity == "relaxation time")
      check("Relaxation time", relaxation_time, Ranges::positive);
    if (viscosity == "isotropic")
      {
        check("Viscous modulus", viscous_modulus, Ranges::positive);
        check("Viscous Poisson ratio",
              viscous_poisson_ratio,
              Ranges::viscous_ratio);
      }
    if (viscosity == "matrix")
      {
        checker.demand(!viscosity_matrix.empty(),
                       "Viscosity matrix",
                       viscosity_matrix,
                       "must be given, for the viscosity is \"matrix\": a list "
                       "such as 9, 2, 0; 2, 9, 0; 0, 0, 3 (plane stress), its "
                       "rows separated by semicolons");
        check_entries("Viscosity matrix", viscosity_matrix, checker);
      }
    if (viscosity == "chain")
      checker.demand_readable("Chain", chain, [&]() {
        for (const ChainBranch &branch : parse_chain(chain))
          check("Chain", branch.relaxation_time, Ranges::positive);
      });
  }
} // namespace Crevasse
