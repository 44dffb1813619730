// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/expression.h>
#include <crevasse/base/text.h>
#include <crevasse/parameters/coefficients.h>
#include <crevasse/parameters/effects.h>

namespace Crevasse
{
  namespace
  {
    /** On what a parameter depends that changes in time; nothing if it does
     * not change. */
    std::string
    cause_of_variation(const std::string &formulas,
                       const bool         temperature_varies)
    {
      bool depends_on_t = false, depends_on_theta = false;
      for (const Expression &formula : parse_coefficients(formulas))
        {
          depends_on_t     = depends_on_t || formula.depends_on_time();
          depends_on_theta = depends_on_theta || (formula.depends_on("theta") &&
                                                  temperature_varies);
        }
      return depends_on_t ? "t" : (depends_on_theta ? "theta" : "");
    }



    /** Which of some parameters depend on time, and how; nothing if none does.
     */
    std::string
    those_that_vary(const Formulas &parameters, const bool temperature_varies)
    {
      std::vector<std::string> all;
      for (const auto &[name, formulas] : parameters)
        if (const std::string cause =
              cause_of_variation(formulas, temperature_varies);
            !cause.empty())
          all.push_back(Text::parameter(MaterialParameters::section, name) +
                        " depends on " + cause);
      return Text::join(all, ", ");
    }



    Effects::Effect
    variation(const std::string &property,
              const Formulas    &formulas,
              const char        *factor_name,
              const std::string &factor,
              const bool         temperature_varies)
    {
      const std::string name   = "varying " + property;
      const std::string reason = those_that_vary(formulas, temperature_varies);
      if (!reason.empty())
        return {name, true, "freely: " + reason};
      const std::string varying_factor =
        those_that_vary({{factor_name, factor}}, temperature_varies);
      if (!varying_factor.empty())
        return {name, true, "by a factor: " + varying_factor};
      return {name, false, "nothing of the " + property + " depends on time"};
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

    thermal_strain = {"thermal strain",
                      expands(material) && is_warm(scene.loads),
                      !expands(material)
                        ? "[Material] Thermal expansion is 0"
                        : "[Loads] Temperature = " + scene.loads.temperature};

    varying_stiffness = variation("stiffness",
                                  stiffness_formulas(material),
                                  "Stiffness time factor",
                                  material.stiffness_time_factor,
                                  temperature_varies);
    varying_viscosity = viscosity.on
                          ? variation("viscosity",
                                      viscosity_formulas(material),
                                      "Viscosity time factor",
                                      material.viscosity_time_factor,
                                      temperature_varies)
                          : Effect{"varying viscosity", false, "no viscosity"};

    body_force = {"body force",
                  !are_zero(Expression::parse_list(scene.loads.body_force)),
                  "[Loads] Body force " + (scene.loads.body_force.empty()
                                             ? "is not set"
                                             : "= " + scene.loads.body_force)};

    const unsigned int n_singular = scene.discretisation.singular_functions;
    singular_functions            = {"singular functions",
                                     n_singular > 0,
                                     "[Discretisation] Singular functions = " +
                                       std::to_string(n_singular)};

    stress_intensity = {"stress intensity",
                        scene.crack_tip.stress_intensity,
                        std::string("[Crack tip] Stress intensity = ") +
                          (scene.crack_tip.stress_intensity ? "true"
                                                            : "false")};

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
            singular_functions,
            stress_intensity,
            field_output};
  }
} // namespace Crevasse
