// ---------------------------------------------------------------------
//
// Copyright (C) 2026 by the Crevasse authors
//
// This file is part of Crevasse. It is free software; you can use it,
// redistribute it and/or modify it under the terms of the GNU Lesser
// General Public License as published by the Free Software Foundation;
// either version 2.1 of the License, or (at your option) any later version.
//
// ---------------------------------------------------------------------

#include <crevasse/scene/chain.h>
#include <crevasse/scene/effects.h>
#include <crevasse/scene/expression.h>
#include <crevasse/scene/temperature.h>
#include <crevasse/scene/text.h>

#include <algorithm>
#include <tuple>
#include <utility>

namespace Crevasse
{
  namespace
  {
    using Formulas = std::vector<std::pair<const char *, std::string>>;



    std::vector<Expression>
    parse(const std::string &formulas)
    {
      std::vector<Expression> all;
      for (const std::string &row : Text::split(formulas, ';'))
        for (Expression &formula : Expression::parse_row(
               row, Expression::Variables::space_time_and_material))
          all.push_back(std::move(formula));
      return all;
    }



    bool
    is_zero(const std::vector<Expression> &formulas)
    {
      return std::all_of(formulas.begin(),
                         formulas.end(),
                         [](const Expression &formula) {
                           return formula.is_zero();
                         });
    }



    /** The first of some parameters that depends on time; nothing if none
     * does. */
    std::string
    first_that_varies(const Formulas &parameters, const bool temperature_varies)
    {
      for (const auto &[name, formulas] : parameters)
        for (const Expression &formula : parse(formulas))
          {
            const std::string what =
              Text::parameter(MaterialParameters::section, name) + " = " +
              formulas;
            if (formula.depends_on_time())
              return what + " depends on t";
            if (formula.depends_on("theta") && temperature_varies)
              return what + " depends on theta";
          }
      return "";
    }



    /** The coefficients of the stiffness, without its factor. */
    Formulas
    stiffness_formulas(const MaterialParameters &material)
    {
      if (!material.stiffness_matrix.empty())
        return {{"Stiffness matrix", material.stiffness_matrix}};
      return {{"Young modulus", material.young_modulus},
              {"Poisson ratio", material.poisson_ratio}};
    }



    /** Those of the viscosity, likewise. */
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



    Effects::Effect
    variation(const std::string &name,
              const Formulas    &formulas,
              const char        *factor_name,
              const std::string &factor,
              const bool         temperature_varies)
    {
      const std::string reason =
        first_that_varies(formulas, temperature_varies);
      if (!reason.empty())
        return {name, true, "freely: " + reason};
      const std::string varying_factor =
        first_that_varies({{factor_name, factor}}, temperature_varies);
      if (!varying_factor.empty())
        return {name, true, "by a factor: " + varying_factor};
      return {name, false, "no coefficient depends on time"};
    }
  } // namespace



  Effects::Effects(const Scene         &scene,
                   const BoundaryRoles &roles,
                   const bool           temperature_varies)
  {
    const MaterialParameters &material = scene.material;

    contact.name = "contact";
    contact.on   = !roles.contact.empty();
    contact.why  = contact.on ? "a boundary has the role Contact"
                              : "no boundary has the role Contact";

    viscosity.name = "viscosity";
    viscosity.on   = material.viscosity != "none";
    viscosity.why  = "[Material] Viscosity = " + material.viscosity;

    chain = {"chain",
             material.viscosity == "chain",
             material.viscosity == "chain"
               ? "[Material] Chain = " + material.chain
               : "at most one Maxwell body"};

    const bool expands = !is_zero(parse(material.thermal_expansion));
    const bool is_warm = Temperature<2>::is_file(scene.loads.temperature) ||
                         !Expression(scene.loads.temperature).is_zero();
    thermal_strain = {"thermal strain",
                      expands && is_warm,
                      !expands
                        ? "[Material] Thermal expansion is 0"
                        : "[Loads] Temperature = " + scene.loads.temperature};

    varying_stiffness = variation("varying stiffness",
                                  stiffness_formulas(material),
                                  "Stiffness time factor",
                                  material.stiffness_time_factor,
                                  temperature_varies);
    varying_viscosity = viscosity.on
                          ? variation("varying viscosity",
                                      viscosity_formulas(material),
                                      "Viscosity time factor",
                                      material.viscosity_time_factor,
                                      temperature_varies)
                          : Effect{"varying viscosity", false, "no viscosity"};

    body_force = {"body force",
                  !is_zero(Expression::parse_list(scene.loads.body_force)),
                  "[Loads] Body force " + (scene.loads.body_force.empty()
                                             ? "is not set"
                                             : "= " + scene.loads.body_force)};

    field_output.name = "field output";
    field_output.on   = scene.output.fields != "none";
    field_output.why  = "[Output] Fields = " + scene.output.fields;
  }



  std::vector<Effects::Effect>
  Effects::list() const
  {
    return {contact,
            viscosity,
            chain,
            thermal_strain,
            varying_stiffness,
            varying_viscosity,
            body_force,
            field_output};
  }
} // namespace Crevasse
