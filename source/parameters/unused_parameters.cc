// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/text.h>
#include <crevasse/parameters/boundary_roles.h>
#include <crevasse/parameters/built_in_boundary.h>
#include <crevasse/parameters/formulas_of_scene.h>
#include <crevasse/parameters/unused_parameters.h>

#include <deal.II/base/parameter_handler.h>

#include <map>

namespace Crevasse
{
  namespace
  {
    /** A parameter, when it is not used, and why. */
    struct Rule
    {
      const char *section;
      const char *name;
      bool        unused;
      std::string reason;
    };

    using Rules = std::vector<Rule>;



    bool
    has_contact(const Scene &scene)
    {
      return !resolve_roles(scene.boundary, built_in_roles(scene.geometry))
                .contact.empty();
    }

    const std::string no_contact = "no boundary has the role Contact";



    Rules
    rules_of_body(const Scene &scene)
    {
      const Shape       shape     = scene.geometry.shape;
      const std::string why       = "Shape = " + name_of(shape);
      const char       *here      = GeometryParameters::section;
      const bool        from_file = shape == Shape::mesh_file;
      const bool        is_plane  = scene.dimension == 2;
      return {
        {here, "Width", from_file, why},
        {here, "Height", from_file, why},
        {here, "Thickness", from_file, why},
        {here, "Thickness", is_plane, "Dimension = 2"},
        {here, "Crack length", !traits(shape).has_crack, why},
        {here, "Subdivisions", from_file, why},
        {BoundaryParameters::section,
         "Loaded",
         are_zero(*scene.loads.traction),
         "there is no [Loads] Traction"},
        {BoundaryParameters::section, "Gap", !has_contact(scene), no_contact},
        {MaterialParameters::section,
         "Plane state",
         !is_plane,
         "Dimension = 3"},
      };
    }



    Rules
    rules_of_material(const Scene &scene)
    {
      const MaterialParameters &material = scene.material;
      const char               *here     = MaterialParameters::section;
      const ViscosityType       kind     = material.viscosity;
      const std::string         why      = "Viscosity = " + name_of(kind);
      const bool        has_matrix = !material.stiffness_matrix.text().empty();
      const std::string matrix     = "Stiffness matrix is given";
      return {
        {here, "Young modulus", has_matrix, matrix},
        {here, "Poisson ratio", has_matrix, matrix},
        {here, "Relaxation time", kind != ViscosityType::relaxation_time, why},
        {here, "Viscous modulus", kind != ViscosityType::isotropic, why},
        {here, "Viscous Poisson ratio", kind != ViscosityType::isotropic, why},
        {here, "Viscosity matrix", kind != ViscosityType::matrix, why},
        {here, "Chain", kind != ViscosityType::chain, why},
        {here, "Viscosity time factor", kind == ViscosityType::none, why},
        {here,
         "Thermal expansion",
         !has_temperature(scene.loads),
         "[Loads] Temperature = 0"},
        {LoadParameters::section,
         "Temperature",
         !has_thermal_expansion(material) &&
           !material_depends_on("theta", material),
         "[Material] Thermal expansion = 0, and no coefficient depends on "
         "theta"},
      };
    }



    Rules
    rules_of_solvers(const Scene &scene)
    {
      const ContactParameters &contact = scene.contact;
      const char              *here    = ContactParameters::section;
      const std::string        why     = "Solver = " + name_of(contact.solver);
      const auto              &solver  = traits(contact.solver);
      const auto              &linear  = traits(scene.linear_solver.type);
      const bool               table   = !contact.relaxation_table.empty();
      const bool               varies =
        material_depends_on("t", scene.material) ||
        material_depends_on("theta", scene.material) ||
        (has_thermal_expansion(scene.material) && has_temperature(scene.loads));
      const bool implicit =
        scene.material.viscosity != ViscosityType::none &&
        traits(scene.time_integration.scheme).keeps_matrices;
      return {
        {here, "Solver", !has_contact(scene), no_contact},
        {here, "Relaxation factor", !has_contact(scene), no_contact},
        {here, "Relaxation factor", !solver.relaxes, why},
        {here, "Maximum iterations", !solver.counts_iterations && !table, why},
        {LinearSolverParameters::section,
         "Tolerance",
         linear.is_direct,
         std::string("Type = ") + linear.name},
        {LinearSolverParameters::section,
         "Tolerance",
         !solver.stops_early,
         "[Contact] " + why},
        {LinearSolverParameters::section,
         "Memory for instants",
         !varies && !implicit,
         "the material does not vary in time"},
      };
    }



    Rules
    rules_of_time(const Scene &scene)
    {
      const TimeIntegrationParameters &time = scene.time_integration;
      const char *here     = TimeIntegrationParameters::section;
      const bool  uniform  = time.step_control == StepControlType::uniform;
      const bool  adaptive = time.step_control == StepControlType::adaptive;
      const bool  elastic  = scene.material.viscosity == ViscosityType::none;
      const std::string control =
        "Step control = " + name_of(time.step_control);
      const std::string none   = "[Material] Viscosity = none";
      const std::string scheme = "Scheme = " + name_of(time.scheme);
      return {
        {here, "Scheme", elastic, none},
        {here, "Heun weight", elastic, none},
        {here, "Heun weight", time.scheme != Scheme::heun, scheme},
        {here,
         "Steps per period",
         time.step_control == StepControlType::list,
         control},
        {here, "Steps", uniform, control},
        {here, "Relative tolerance", elastic, none},
        {here, "Absolute tolerance", elastic, none},
        {here, "Relative tolerance", !adaptive, control},
        {here, "Absolute tolerance", !adaptive, control},
        {here, "Order", elastic, none},
        {here, "Order", !traits(time.scheme).is_of_arkode, scheme},
        {here, "Locate contact events", elastic, none},
        {here, "Locate contact events", !has_contact(scene), no_contact},
        {here, "Check stability", elastic, none},
        {OutputParameters::section,
         "Field times",
         scene.output.fields == FieldFormat::none,
         "Fields = none"},
      };
    }



    Rules
    rules_of_periodic_state(const Scene &scene)
    {
      const PeriodicStateParameters &periodic = scene.periodic_state;
      const char                    *here = PeriodicStateParameters::section;
      const bool elastic    = scene.material.viscosity == ViscosityType::none;
      const bool direct     = periodic.method == PeriodicMethodType::fourier;
      const bool automatic  = periodic.method == PeriodicMethodType::automatic;
      const bool is_started = periodic.start_from == StartFrom::fourier;
      const bool combines =
        periodic.method == PeriodicMethodType::anderson || automatic;
      const std::string none   = "[Material] Viscosity = none";
      const std::string method = "Method = " + name_of(periodic.method);
      Rules             rules  = {
                     {here, "Secular split", elastic, none},
                     {here,
                      "Maximum periods",
                      elastic && periodic.maximum_periods > 1,
                      none + ", one period tells all"},
                     {here, "Method", elastic, none + ", one period tells all"},
                     {TimeIntegrationParameters::section,
                      "Locate contact events",
                      direct,
                      "[Periodic state] " + method},
                     {TimeIntegrationParameters::section,
                      "Scheme",
                      direct && scene.time_integration.scheme != Scheme::trapezoid,
                      "[Periodic state] " + method + " is the trapezoidal rule"},
                     {here, "Start from", elastic, none},
                     {here, "Start from", direct || automatic, method},
                     {here,
                      "Harmonics",
                      elastic || !(direct || automatic || is_started),
         elastic ? none : method},
      };
      for (const char *name :
           {"Anderson depth", "Anderson damping", "Anderson delay"})
        rules.push_back({here, name, !combines, method});
      return rules;
    }



    Rules
    rules_of_crack_tip(const Scene &scene)
    {
      const CrackTipParameters &tip  = scene.crack_tip;
      const char               *here = CrackTipParameters::section;
      const std::string law   = "Crack growth law = " + name_of(tip.growth_law);
      const auto       &parts = traits(tip.growth_law);

      const std::string off   = "Stress intensity = false";
      Rules             rules = {{here, "Method", !tip.stress_intensity, off},
                                 {here, "Radius", !tip.stress_intensity, off}};
      for (const char *name :
           {"Paris factor", "Paris exponent", "Paris threshold"})
        rules.push_back({here, name, !parts.has_paris_part, law});
      for (const char *name :
           {"Creep growth parameter", "Creep factor", "Creep exponent"})
        rules.push_back({here, name, !parts.has_creep_part, law});
      return rules;
    }



    Rules
    rules_of_refinement(const Scene &scene)
    {
      const RefinementParameters &refinement = scene.refinement;
      const char                 *here       = RefinementParameters::section;
      const bool none     = refinement.strategy == RefinementStrategy::none;
      const bool adaptive = refinement.strategy == RefinementStrategy::adaptive;
      const std::string why   = "Strategy = " + name_of(refinement.strategy);
      Rules             rules = {{here, "Target unknowns", none, why},
                                 {here, "Cycles", none, why}};
      for (const char *name : {"Marking",
                               "Refine fraction",
                               "Coarsen fraction",
                               "Tolerance",
                               "Instants"})
        rules.push_back({here, name, !adaptive, why});
      return rules;
    }



    /** The values of all parameters as a scene file has them. */
    std::map<std::pair<std::string, std::string>, std::string>
    values_of(Scene scene, const Rules &rules)
    {
      dealii::ParameterHandler prm;
      scene.add_parameters(prm);
      std::map<std::pair<std::string, std::string>, std::string> values;
      for (const Rule &rule : rules)
        values[{rule.section, rule.name}] = prm.get({rule.section}, rule.name);
      return values;
    }
  } // namespace



  std::vector<std::string>
  unused_parameters(const Scene &scene)
  {
    Rules rules;
    for (const Rules &part : {rules_of_body(scene),
                              rules_of_material(scene),
                              rules_of_solvers(scene),
                              rules_of_time(scene),
                              rules_of_periodic_state(scene),
                              rules_of_refinement(scene),
                              rules_of_crack_tip(scene)})
      rules.insert(rules.end(), part.begin(), part.end());

    auto                     values   = values_of(scene, rules);
    const auto               defaults = values_of(Scene(), rules);
    std::vector<std::string> sentences;
    for (const Rule &rule : rules)
      {
        std::string       &value = values.at({rule.section, rule.name});
        const std::string &usual = defaults.at({rule.section, rule.name});
        if (!rule.unused || value == usual)
          continue;
        sentences.push_back(Text::parameter(rule.section, rule.name) + " = " +
                            Text::shorten(value) +
                            " is not used: " + rule.reason);
        value = usual; // one reason is enough
      }
    return sentences;
  }
} // namespace Crevasse
