// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/parameters/formulas_of_scene.h>

#include <algorithm>
#include <set>

namespace Crevasse
{
  namespace
  {
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
      for (const ChainBranch &branch : *material.chain)
        formulas.push_back(branch.relaxation_time);
    else
      formulas.push_back(*material.relaxation_time);
    return formulas;
  }



  bool
  material_depends_on(const std::string        &variable,
                      const MaterialParameters &material)
  {
    return depend_on(variable, stiffness_formulas(material)) ||
           depend_on(variable, viscosity_formulas(material)) ||
           depend_on(variable, free_strain_formulas(material));
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
    return !*loads.temperature || !(*loads.temperature)->is_zero();
  }



  bool
  formulas_can_jump(const Scene &scene)
  {
    const MaterialParameters        &material    = scene.material;
    const std::optional<Expression> &temperature = *scene.loads.temperature;

    std::vector<Expression> formulas = stiffness_formulas(material);
    append(viscosity_formulas(material), formulas);
    append({*material.stiffness_time_factor, *material.viscosity_time_factor},
           formulas);
    append(*scene.loads.traction, formulas);
    append(*scene.loads.body_force, formulas);
    append(free_strain_formulas(material), formulas);
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



  std::string
  describe_variation(const std::vector<Expression> &formulas,
                     const bool                     temperature_varies)
  {
    std::string           sentences;
    std::set<std::string> seen; // a matrix has many formulas under one name
    for (const Expression &formula : formulas)
      {
        const bool by_time = formula.depends_on("t");
        if ((by_time || (temperature_varies && formula.depends_on("theta"))) &&
            seen.insert(formula.parameter()).second)
          sentences += (sentences.empty() ? "" : ", ") + formula.parameter() +
                       " depends on " + (by_time ? "t" : "theta");
      }
    return sentences;
  }
} // namespace Crevasse
