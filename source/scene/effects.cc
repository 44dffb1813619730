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

#include <crevasse/scene/coefficients.h>
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
        for (const Expression &formula : parse_coefficients(formulas))
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

    const bool expands =
      !is_zero(parse_coefficients(material.thermal_expansion));
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

    secular_flow = {"secular flow", false, "not looked for"};

    field_output.name = "field output";
    field_output.on   = scene.output.fields != "none";
    field_output.why  = "[Output] Fields = " + scene.output.fields;
  }



  std::vector<Effects::Effect>
  Effects::list() const
  {
    return {contact,
            viscosity,
            secular_flow,
            chain,
            thermal_strain,
            varying_stiffness,
            varying_viscosity,
            body_force,
            field_output};
  }
} // namespace Crevasse
