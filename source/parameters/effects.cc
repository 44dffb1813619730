// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/text.h>
#include <crevasse/parameters/effects.h>
#include <crevasse/parameters/formulas_of_scene.h>

#include <algorithm>

namespace Crevasse
{
  namespace
  {
    Effects::Effect
    variation(const std::string             &property,
              const std::vector<Expression> &formulas,
              const Expression              &factor,
              const bool                     temperature_varies)
    {
      const std::string name = "varying " + property;
      const std::string reason =
        describe_variation(formulas, temperature_varies);
      if (!reason.empty())
        return {name, true, "freely: " + reason};
      const std::string varying_factor =
        describe_variation({factor}, temperature_varies);
      if (!varying_factor.empty())
        return {name, true, "by a factor: " + varying_factor};
      return {name, false, "nothing of the " + property + " depends on time"};
    }



    Effects::Effect
    free_strain(const MaterialParameters::FreeStrain &strain,
                const LoadParameters                 &loads)
    {
      const std::string name =
        Text::parameter(MaterialParameters::section, strain.parameter);
      if (are_zero(*strain.components))
        return {strain.effect, false, name + " is 0"};
      if (strain.is_thermal)
        return {strain.effect,
                has_temperature(loads),
                "[Loads] Temperature = " + loads.temperature.text()};
      return {strain.effect, true, name + " = " + strain.components.text()};
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
    viscosity.on   = material.viscosity != ViscosityType::none;
    viscosity.why  = "[Material] Viscosity = " + name_of(material.viscosity);

    const bool is_chain = material.viscosity == ViscosityType::chain;
    chain               = {"chain",
                           is_chain,
             is_chain ? "[Material] Chain = " + material.chain.text()
                                    : "at most one Maxwell body"};

    for (const auto &strain : material.free_strains())
      free_strains.push_back(free_strain(strain, scene.loads));

    varying_stiffness = variation("stiffness",
                                  stiffness_formulas(material),
                                  *material.stiffness_time_factor,
                                  temperature_varies);
    varying_viscosity = viscosity.on
                          ? variation("viscosity",
                                      viscosity_formulas(material),
                                      *material.viscosity_time_factor,
                                      temperature_varies)
                          : Effect{"varying viscosity", false, "no viscosity"};

    body_force = {"body force",
                  !are_zero(*scene.loads.body_force),
                  "[Loads] Body force " +
                    (scene.loads.body_force->empty()
                       ? "is not set"
                       : "= " + scene.loads.body_force.text())};

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
    field_output.on   = scene.output.fields != FieldFormat::none;
    field_output.why  = "[Output] Fields = " + name_of(scene.output.fields);
  }



  bool
  Effects::has_free_strain() const
  {
    return std::any_of(free_strains.begin(),
                       free_strains.end(),
                       [](const Effect &effect) { return effect.on; });
  }



  std::vector<Effects::Effect>
  Effects::list() const
  {
    std::vector<Effect> all = {contact, viscosity, secular_flow, chain};
    all.insert(all.end(), free_strains.begin(), free_strains.end());
    for (const Effect &effect : {varying_stiffness,
                                 varying_viscosity,
                                 body_force,
                                 singular_functions,
                                 stress_intensity,
                                 field_output})
      all.push_back(effect);
    return all;
  }
} // namespace Crevasse
