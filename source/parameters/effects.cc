// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/parameters/automatic.h>
#include <crevasse/parameters/effects.h>

#include <algorithm>

namespace Crevasse
{
  namespace
  {
    /** Names of the formulas that vary in time, and why: "[Material] Relaxation
     * time depends on theta"; empty if none does. */
    std::string
    describe_variation(const std::vector<Expression> &formulas,
                       const bool                     temperature_varies)
    {
      std::string           sentences;
      std::set<std::string> seen; // a matrix has many formulas under one name
      for (const Expression &formula : formulas)
        {
          const bool by_time = formula.depends_on("t");
          if ((by_time ||
               (temperature_varies && formula.depends_on("theta"))) &&
              seen.insert(formula.parameter()).second)
            sentences += (sentences.empty() ? "" : ", ") + formula.parameter() +
                         " depends on " + (by_time ? "t" : "theta");
        }
      return sentences;
    }



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
              by.empty() ? "the " + property + " does not depend on time"
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



    Effects::Effect
    volume_force(const LoadParameters::Force &force)
    {
      const std::string name = std::string("[Loads] ") + force.parameter;
      return {force.effect,
              !are_zero(force.formulas()),
              name + (force.values->empty() ? " is not set"
                                            : " = " + force.values.text())};
    }



    /** Why K is not computed automatically; empty if it is. */
    std::string
    reason_against_intensity(const Scene &scene, const BoundaryRoles &roles)
    {
      if (scene.dimension == 3)
        return "Dimension = 3";
      if (!roles.has_lip())
        return "no boundary has the role Contact, Crack or Open crack";
      if (scene.material.creep_law() != nullptr)
        return "creep is nonlinear in the stress: see [Crack tip] Creep "
               "integral";
      if (scene.is_axisymmetric() && !creeps_in_proportion(scene.material))
        return "the body is axisymmetric, and its viscosity is not "
               "proportional to its stiffness";
      return "";
    }



    void
    append(const std::vector<Expression> &more, std::vector<Expression> &all)
    {
      all.insert(all.end(), more.begin(), more.end());
    }



    std::vector<Expression>
    free_strain_formulas(const MaterialParameters &material)
    {
      std::vector<Expression> all;
      for (const auto &strain : material.free_strains())
        append(*strain.components, all);
      return all;
    }
  } // namespace



  Effects::Effects(const Scene         &scene,
                   const BoundaryRoles &roles,
                   const bool           temperature_varies)
  {
    const MaterialParameters &material    = scene.material;
    const bool                has_contact = roles.has_contact();
    const bool is_chain = material.viscosity == ViscosityType::chain;
    const auto [n_singular, why_singular] = Crevasse::singular_functions(scene);

    contact   = {"contact",
                 has_contact,
                 std::string(has_contact ? "a" : "no") +
                   " boundary has the role " +
                   (roles.crack.empty() ? "Contact" : "Crack")};
    friction  = {"friction",
                 roles.has_friction,
                 "[Boundary] Friction coefficient = " +
                   scene.boundary.friction.text()};
    viscosity = {"viscosity",
                 material.viscosity != ViscosityType::none,
                 "[Material] Viscosity = " + name_of(material.viscosity)};
    if (const CreepLaw *law = material.creep_law())
      for (const CreepLawParameter &parameter : law->parameters)
        viscosity.why += std::string(", ") + parameter.name + " = " +
                         material.of_creep.at(parameter.name).text();
    secular_flow = {"secular flow", false, "not looked for"};
    chain        = {"chain",
                    is_chain,
             is_chain ? (material.chain_in_shear_only
                                  ? "in shear only, [Material] Chain = "
                                  : "[Material] Chain = ") +
                          material.chain.text()
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
    for (const auto &force : scene.loads.forces())
      if (force.in_volume)
        volume_forces.push_back(volume_force(force));
    const bool is_displaced = !roles.displaced.empty();
    imposed_displacement    = {"imposed displacement",
                               is_displaced,
                            is_displaced
                                 ? "[Loads] Displacement = " +
                                  scene.loads.displacement.text()
                                 : "no boundary has the role Displaced"};
    singular_functions = {"singular functions", n_singular > 0, why_singular};
    stress_intensity   = stress_intensity_effect(scene, roles);
    field_output       = {"field output",
                          scene.output.fields != FieldFormat::none,
                          "[Output] Fields = " + name_of(scene.output.fields)};
  }



  bool
  creeps_in_proportion(const MaterialParameters &material)
  {
    return material.stiffness_matrix.text().empty() &&
           material.viscosity != ViscosityType::matrix &&
           !material.relaxes_in_shear_only() &&
           (material.viscosity != ViscosityType::isotropic ||
            material.viscous_poisson_ratio.text() ==
              material.poisson_ratio.text());
  }



  Effects::Effect
  stress_intensity_effect(const Scene &scene, const BoundaryRoles &roles)
  {
    const CrackTipParameters &tip     = scene.crack_tip;
    const std::string         name    = "stress intensity";
    const std::string         section = "[Crack tip] ";
    if (tip.stress_intensity != StressIntensityChoice::automatic)
      return {name,
              tip.needs_stress_intensity(),
              section + "Stress intensity = " + name_of(tip.stress_intensity)};
    if (tip.needs_stress_intensity())
      return {name,
              true,
              section + "Crack growth law = " + traits(tip.growth_law).name};
    const std::string against = reason_against_intensity(scene, roles);
    return {name,
            against.empty(),
            "automatic: " +
              (against.empty() ? "a crack in the plane" : against)};
  }



  const Effects::Effect *
  Effects::first_on(const std::vector<Effect> &effects)
  {
    for (const Effect &effect : effects)
      if (effect.on)
        return &effect;
    return nullptr;
  }



  std::vector<Effects::Effect>
  Effects::list() const
  {
    std::vector<Effect> all = {
      contact, friction, viscosity, secular_flow, chain};
    const auto add = [&all](const std::vector<Effect> &more) {
      all.insert(all.end(), more.begin(), more.end());
    };
    add(free_strains);
    add({varying_stiffness, varying_viscosity});
    add(volume_forces);
    add({imposed_displacement,
         singular_functions,
         stress_intensity,
         field_output});
    return all;
  }



  std::vector<Expression>
  stiffness_formulas(const MaterialParameters &material)
  {
    if (!material.stiffness_matrix.text().empty())
      return entries(material.stiffness_matrix);
    return {*material.young_modulus, *material.poisson_ratio};
  }



  std::vector<Expression>
  viscosity_formulas(const MaterialParameters &material)
  {
    if (const CreepLaw *law = material.creep_law())
      {
        std::vector<Expression> formulas;
        for (const CreepLawParameter &parameter : law->parameters)
          formulas.push_back(*material.of_creep.at(parameter.name));
        return formulas;
      }
    switch (material.viscosity)
      {
        case ViscosityType::none:
          return {};
        case ViscosityType::isotropic:
          return {*material.viscous_modulus, *material.viscous_poisson_ratio};
        case ViscosityType::matrix:
          return entries(material.viscosity_matrix);
        default:
          break;
      }
    std::vector<Expression> formulas = stiffness_formulas(material);
    if (material.viscosity == ViscosityType::chain)
      for (const ChainBranch &branch : material.branches())
        formulas.push_back(branch.relaxation_time);
    else
      formulas.push_back(*material.relaxation_time);
    return formulas;
  }



  std::vector<Expression>
  material_formulas(const MaterialParameters &material)
  {
    std::vector<Expression> all = stiffness_formulas(material);
    append(viscosity_formulas(material), all);
    append(free_strain_formulas(material), all);
    return all;
  }



  bool
  material_depends_on(const std::string        &variable,
                      const MaterialParameters &material)
  {
    return depend_on(variable, material_formulas(material));
  }



  bool
  has_thermal_expansion(const MaterialParameters &material)
  {
    for (const auto &strain : material.free_strains())
      if (strain.is_thermal && !are_zero(*strain.components))
        return true;
    return false;
  }



  bool
  has_temperature(const LoadParameters &loads)
  {
    return !*loads.temperature || !(*loads.temperature)->is_zero() ||
           loads.reference->value_or(0.) != 0.;
  }



  bool
  formulas_can_jump(const Scene &scene)
  {
    const MaterialParameters        &material    = scene.material;
    const std::optional<Expression> &temperature = *scene.loads.temperature;

    std::vector<Expression> formulas = material_formulas(material);
    append({*material.stiffness_time_factor, *material.viscosity_time_factor},
           formulas);
    for (const auto &force : scene.loads.forces())
      append(force.formulas(), formulas);
    for (const auto *values :
         {&scene.boundary.friction, &scene.loads.displacement})
      append(formulas_of(*values), formulas);
    if (temperature)
      formulas.push_back(*temperature);

    const bool theta_varies = !temperature || temperature->depends_on_time();
    return std::any_of(formulas.begin(),
                       formulas.end(),
                       [theta_varies](const Expression &formula) {
                         return formula.can_jump_with("t") ||
                                (theta_varies &&
                                 formula.can_jump_with("theta"));
                       });
  }
} // namespace Crevasse
