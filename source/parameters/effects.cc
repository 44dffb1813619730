// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

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
      const std::string free = describe_variation(formulas, temperature_varies);
      if (!free.empty())
        return {name, true, "freely: " + free};
      const std::string by = describe_variation({factor}, temperature_varies);
      return {name,
              !by.empty(),
              by.empty() ? "nothing of the " + property + " depends on time"
                         : "by a factor: " + by};
    }



    Effects::Effect
    free_strain(const MaterialParameters::FreeStrain &strain,
                const LoadParameters                 &loads)
    {
      const std::string name = std::string("[Material] ") + strain.parameter;
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
    const Formulas           &force    = scene.loads.body_force;
    const unsigned int n_singular  = scene.discretisation.singular_functions;
    const bool         has_contact = !roles.contact.empty();
    const bool         is_chain    = material.viscosity == ViscosityType::chain;
    const bool         has_tip     = scene.crack_tip.stress_intensity;

    contact      = {"contact",
                    has_contact,
                    std::string(has_contact ? "a" : "no") +
                      " boundary has the role Contact"};
    viscosity    = {"viscosity",
                    material.viscosity != ViscosityType::none,
                    "[Material] Viscosity = " + name_of(material.viscosity)};
    secular_flow = {"secular flow", false, "not looked for"};
    chain        = {"chain",
                    is_chain,
             is_chain ? "[Material] Chain = " + material.chain.text()
                             : "at most one Maxwell body"};
    for (const auto &strain : material.free_strains())
      free_strains.push_back(free_strain(strain, scene.loads));
    varying_stiffness  = variation("stiffness",
                                  stiffness_formulas(material),
                                  *material.stiffness_time_factor,
                                  temperature_varies);
    varying_viscosity  = viscosity.on
                           ? variation("viscosity",
                                      viscosity_formulas(material),
                                      *material.viscosity_time_factor,
                                      temperature_varies)
                           : Effect{"varying viscosity", false, "no viscosity"};
    body_force         = {"body force",
                          !are_zero(*force),
                          "[Loads] Body force " +
                            (force->empty() ? "is not set" : "= " + force.text())};
    singular_functions = {"singular functions",
                          n_singular > 0,
                          "[Discretisation] Singular functions = " +
                            std::to_string(n_singular)};
    stress_intensity   = {"stress intensity",
                          has_tip,
                          std::string("[Crack tip] Stress intensity = ") +
                            (has_tip ? "true" : "false")};
    field_output       = {"field output",
                          scene.output.fields != FieldFormat::none,
                          "[Output] Fields = " + name_of(scene.output.fields)};
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
    std::vector<Effect> all = {contact,
                               viscosity,
                               secular_flow,
                               chain,
                               varying_stiffness,
                               varying_viscosity,
                               body_force,
                               singular_functions,
                               stress_intensity,
                               field_output};
    all.insert(all.begin() + 4, free_strains.begin(), free_strains.end());
    return all;
  }
} // namespace Crevasse
