// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/text.h>
#include <crevasse/parameters/built_in_boundary.h>
#include <crevasse/parameters/effects.h>

namespace Crevasse
{
  namespace
  {
    /** Rule for parameters of a section, "Section/Name, other name": whether
     * they are unused, and why. */
    struct Rule
    {
      std::string parameters;
      bool        unused;
      std::string reason;
    };

    using Rules = std::vector<Rule>;



    Rules
    rules_of_body(const Scene &scene)
    {
      const Shape               shape      = scene.geometry.shape;
      const MaterialParameters &material   = scene.material;
      const std::string         of_shape   = "Shape = " + name_of(shape);
      const ViscosityType       kind       = material.viscosity;
      const std::string         viscosity  = "Viscosity = " + name_of(kind);
      const bool                isotropic  = kind == ViscosityType::isotropic;
      const bool                is_elastic = kind == ViscosityType::none;
      const bool                is_plane   = scene.dimension == 2;
      const bool                from_file  = shape == Shape::mesh_file;
      const bool has_matrix = !material.stiffness_matrix.text().empty();
      const bool theta_acts =
        has_thermal_expansion(material) ||
        material_depends_on("theta", material) ||
        scene.crack_tip.depend_on_temperature() ||
        depend_on("theta", formulas_of(scene.boundary.friction));
      std::string surface_forces;
      bool        has_surface_force = false;
      for (const auto &force : scene.loads.forces())
        if (!force.in_volume)
          {
            surface_forces += (surface_forces.empty() ? "" : " or ") +
                              std::string(force.parameter);
            has_surface_force |= !are_zero(force.formulas());
          }
      Rules rules = {
        {"Geometry/Width, Height, Thickness, Subdivisions",
         from_file,
         of_shape},
        {"Geometry/Thickness", is_plane, "Dimension = 2"},
        {"Geometry/Crack length", !traits(shape).has_crack, of_shape},
        {"Boundary/Loaded",
         !has_surface_force,
         "there is no [Loads] " + surface_forces},
        {"Material/Plane state", !is_plane, "Dimension = 3"},
        {"Material/Young modulus, Poisson ratio",
         has_matrix,
         "Stiffness matrix is given"},
        {"Material/Relaxation time",
         kind != ViscosityType::relaxation_time,
         viscosity},
        {"Material/Viscous modulus, Viscous Poisson ratio",
         !isotropic,
         viscosity},
        {"Material/Viscosity matrix", kind != ViscosityType::matrix, viscosity},
        {"Material/Chain, Chain shift, Chain in shear only",
         kind != ViscosityType::chain,
         viscosity},
        {"Material/Viscosity time factor", is_elastic, viscosity},
        {"Material/Thermal expansion, Mean expansion from",
         !has_temperature(scene.loads),
         "[Loads] Temperature = 0"},
        {"Loads/Temperature, Reference temperature",
         !theta_acts,
         "[Material] Thermal expansion = 0, and no coefficient depends on "
         "theta"},
      };
      std::set<std::string> used;
      if (const CreepLaw *law = material.creep_law())
        for (const CreepLawParameter &parameter : law->parameters)
          used.insert(parameter.name);
      for (const auto &[name, formula] : material.of_creep)
        rules.push_back({"Material/" + name, used.count(name) == 0, viscosity});
      return rules;
    }



    Rules
    rules_of_solvers(const Scene &scene)
    {
      const ContactParameters &contact = scene.contact;
      const bool               has_contact =
        resolve_roles(scene.boundary, built_in_roles(scene.geometry))
          .has_contact();
      const std::string no_contact =
        "no boundary has the role Contact or Crack";
      const std::string of_solver = "Solver = " + name_of(contact.solver);
      const auto       &solver    = traits(contact.solver);
      const auto       &linear    = traits(scene.linear_solver.type);
      const bool        counts    = solver.has(Trait::counts_iterations) ||
                          !contact.relaxation_table.empty();
      const bool varies =
        material_depends_on("t", scene.material) ||
        material_depends_on("theta", scene.material) ||
        (has_thermal_expansion(scene.material) && has_temperature(scene.loads));
      const bool implicit =
        scene.material.viscosity != ViscosityType::none &&
        traits(scene.time_integration.scheme).has(Trait::keeps_matrices);
      return {
        {"Boundary/Gap, Friction coefficient", !has_contact, no_contact},
        {"Time integration/Newton tolerance",
         !implicit || scene.material.creep_law() == nullptr,
         "there is no implicit stage of nonlinear creep"},
        {"Contact/Solver, Relaxation factor", !has_contact, no_contact},
        {"Time integration/Locate contact events", !has_contact, no_contact},
        {"Contact/Relaxation factor", !solver.has(Trait::relaxes), of_solver},
        {"Contact/Maximum iterations", !counts, of_solver},
        {"Linear solver/Tolerance",
         linear.has(Trait::is_direct),
         std::string("Type = ") + linear.name},
        {"Linear solver/Tolerance",
         !solver.has(Trait::stops_early),
         "[Contact] " + of_solver},
        {"Linear solver/Memory for instants",
         !varies && !implicit,
         "the material does not vary in time"},
      };
    }



    Rules
    rules_of_time(const Scene &scene)
    {
      const TimeIntegrationParameters &time     = scene.time_integration;
      const PeriodicStateParameters   &periodic = scene.periodic_state;
      const StepControlType            control  = time.step_control;
      const PeriodicMethodType         method   = periodic.method;

      const bool elastic = scene.material.viscosity == ViscosityType::none;
      const bool has_friction =
        resolve_roles(scene.boundary, built_in_roles(scene.geometry))
          .has_friction;
      const bool        adaptive   = control == StepControlType::adaptive;
      const bool        direct     = method == PeriodicMethodType::fourier;
      const bool        automatic  = method == PeriodicMethodType::automatic;
      const std::string none       = "[Material] Viscosity = none";
      const std::string of_control = "Step control = " + name_of(control);
      const std::string of_scheme  = "Scheme = " + name_of(time.scheme);
      const std::string of_method  = "Method = " + name_of(method);
      return {
        {"Time integration/Scheme, Heun weight, Relative tolerance, Absolute "
         "tolerance, Order, Locate contact events, Check stability",
         elastic,
         none},
        {"Time integration/Heun weight",
         time.scheme != Scheme::heun,
         of_scheme},
        {"Time integration/Order",
         !traits(time.scheme).has(Trait::is_of_arkode),
         of_scheme},
        {"Time integration/Steps per period",
         control == StepControlType::list,
         of_control},
        {"Time integration/Steps",
         control == StepControlType::uniform,
         of_control},
        {"Time integration/Relative tolerance, Absolute tolerance",
         !adaptive,
         of_control},
        {"Time integration/Locate contact events",
         direct,
         "[Periodic state] " + of_method},
        {"Time integration/Scheme",
         direct && time.scheme != Scheme::trapezoid &&
           time.scheme != Scheme::automatic,
         "[Periodic state] " + of_method + " uses the trapezoidal rule"},
        {"Periodic state/Secular split, Harmonics", elastic, none},
        {"Periodic state/Method",
         elastic && !has_friction,
         none + ", one period is enough"},
        {"Periodic state/Maximum periods",
         elastic && !has_friction && periodic.maximum_periods > 1,
         none + ", one period is enough"},
        {"Periodic state/Harmonics", !direct && !automatic, of_method},
        {"Periodic state/Anderson depth",
         method != PeriodicMethodType::anderson &&
           method != PeriodicMethodType::averaged && !automatic,
         of_method},
        {"Periodic state/Averaged poles",
         method != PeriodicMethodType::averaged && !automatic,
         of_method},
        {"Periodic state/Tolerance, Converged quantity",
         !periodic.missions.empty(),
         "Missions seek no periodic state"},
        {"Periodic state/Converged quantity", direct, of_method},
        {"Periodic state/Mission tolerance",
         periodic.missions.empty(),
         "there are no Missions"},
      };
    }



    Rules
    rules_of_results(const Scene &scene)
    {
      const CrackTipParameters &tip       = scene.crack_tip;
      const auto               &law       = traits(tip.growth_law);
      const auto                intensity = stress_intensity_effect(
        scene, resolve_roles(scene.boundary, built_in_roles(scene.geometry)));
      const RefinementStrategy strategy = scene.refinement.strategy;
      const std::string of_law = std::string("Crack growth law = ") + law.name;
      const std::string of_strategy = "Strategy = " + name_of(strategy);
      return {
        {"Refinement/Target unknowns, Cycles",
         strategy == RefinementStrategy::none,
         of_strategy},
        {"Refinement/Marking, Refine fraction, Coarsen fraction, Tolerance, "
         "Instants",
         strategy != RefinementStrategy::adaptive,
         of_strategy},
        {"Crack tip/Method", !intensity.on, intensity.why},
        {"Crack tip/Radius",
         !intensity.on && !tip.creep_integral,
         intensity.why},
        {"Crack tip/Paris factor, Paris exponent, Paris threshold",
         law.fatigue != FatigueLaw::paris && law.fatigue != FatigueLaw::walker,
         of_law},
        {"Crack tip/Walker exponent, Threshold exponent, Toughness exponent",
         law.fatigue != FatigueLaw::walker,
         of_law},
        {"Crack tip/Growth table", law.fatigue != FatigueLaw::table, of_law},
        {"Crack tip/Growth range", law.fatigue == FatigueLaw::none, of_law},
        {"Crack tip/Creep growth parameter, Creep factor, Creep exponent",
         !law.has_creep_part,
         of_law},
        {"Output/Field times",
         scene.output.fields == FieldFormat::none,
         "Fields = none"},
      };
    }
  } // namespace



  std::vector<std::string>
  unused_parameters(const Scene &scene)
  {
    Scene                    own = scene, usual;
    dealii::ParameterHandler values, defaults;
    own.add_parameters(values);
    usual.add_parameters(defaults);
    std::set<std::string>    reported; // one reason is enough
    std::vector<std::string> sentences;
    for (const Rules &rules : {rules_of_body(scene),
                               rules_of_solvers(scene),
                               rules_of_time(scene),
                               rules_of_results(scene)})
      for (const Rule &rule : rules)
        {
          const std::size_t slash   = rule.parameters.find('/');
          const std::string section = rule.parameters.substr(0, slash);
          for (const std::string &name :
               Text::split(rule.parameters.substr(slash + 1), ','))
            if (const std::string value = values.get({section}, name);
                rule.unused && value != defaults.get({section}, name) &&
                reported.insert(section + '/' + name).second)
              sentences.push_back(Text::parameter(section, name) + " = " +
                                  Text::shorten(value) +
                                  " is not used: " + rule.reason);
        }
    return sentences;
  }
} // namespace Crevasse
