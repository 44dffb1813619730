// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/text.h>
#include <crevasse/parameters/automatic.h>
#include <crevasse/parameters/checker.h>
#include <crevasse/parameters/effects.h>
#include <crevasse/parameters/scene.h>
#include <crevasse/parameters/units.h>

namespace Crevasse
{
  namespace
  {
    /** Checks the number of cells; blames only excessive Subdivisions. */
    void
    check_subdivisions(const Scene &scene, Problems &problems)
    {
      const GeometryParameters &geometry = scene.geometry;
      const Checker             checker(GeometryParameters::section, problems);
      checker.demand_valid("Subdivisions", geometry.subdivisions);
      if (geometry.shape == Shape::mesh_file ||
          !geometry.subdivisions.is_valid() ||
          problems.concern(GeometryParameters::section, "Crack length"))
        return;
      const std::vector<unsigned int> n =
        subdivisions(geometry, scene.dimension);
      checker.demand(n.size() == scene.dimension,
                     "Subdivisions",
                     "must be " + std::to_string(scene.dimension) +
                       " integers, one for each dimension");
      checker.demand(!traits(geometry.shape).has_crack || n[0] != 1,
                     "Subdivisions",
                     "must have at least 2 cells along x, because the crack "
                     "tip is a vertex of the mesh");
      constexpr double         most  = 2e7;
      double                   cells = 1.;
      std::vector<std::string> factors;
      for (const unsigned int n_along : n)
        {
          cells *= n_along;
          factors.push_back(std::to_string(n_along));
        }
      const double refined =
        cells * std::pow(2., n.size() * geometry.refinements);
      checker.demand(cells <= most,
                     "Subdivisions",
                     "makes " + Text::from_number(cells) +
                       " cells; at most 2e7 are allowed");
      checker.demand(cells > most || refined <= most,
                     "Refinements",
                     "makes " + Text::from_number(refined) +
                       " cells of Subdivisions = " + Text::join(factors, ", ") +
                       "; at most 2e7 are allowed");
    }



    /** Checks shape, loads and crack tip against the dimension. */
    void
    check_body(const Scene &scene, Problems &problems)
    {
      const Checker geometry(GeometryParameters::section, problems);
      const bool    is_plane  = scene.dimension == 2;
      const auto    dimension = std::to_string(scene.dimension);
      // Shapes without a crack have different names in plane and space.
      geometry.demand(scene.geometry.shape !=
                        (is_plane ? Shape::box : Shape::rectangle),
                      "Shape",
                      "is not allowed with Dimension = " + dimension +
                        "; the body without a crack is \"" +
                        name_of(is_plane ? Shape::rectangle : Shape::box) +
                        "\"");

      scene.loads.check_dimension(scene.dimension, problems);

      const Checker crack_tip(CrackTipParameters::section, problems);
      crack_tip.demand(is_plane || scene.crack_tip.method !=
                                     StressIntensityMethod::williams_fit,
                       "Method",
                       "williams fit is for Dimension = 2");
      crack_tip.demand(
        is_plane || scene.crack_tip.growth_law == GrowthLawType::none,
        "Crack growth law",
        "is for Dimension = 2: in space K varies along the front");
      const bool is_linear = scene.material.creep_law() == nullptr;
      const bool hardens   = !is_linear && scene.material.creep_law()->hardens;
      crack_tip.demand(is_linear || scene.crack_tip.stress_intensity !=
                                      StressIntensityChoice::on,
                       "Stress intensity",
                       "must be false with [Material] Viscosity = " +
                         name_of(scene.material.viscosity) +
                         ": K does not describe the stress at a crack tip "
                         "if creep is nonlinear in the stress" +
                         (hardens ? "" : ". Set Creep integral = true"));
      crack_tip.demand(is_linear ||
                         scene.crack_tip.growth_law == GrowthLawType::none ||
                         (scene.crack_tip.grows_by_C_of_t() && !hardens),
                       "Crack growth law",
                       hardens
                         ? "must be none with creep that hardens, which has "
                           "neither K nor C(t)"
                         : "needs, with [Material] Viscosity = " +
                             name_of(scene.material.viscosity) +
                             ", Creep integral = true and Creep growth "
                             "parameter = C(t)");
      crack_tip.demand(!scene.crack_tip.creep_integral ||
                         (!is_linear && !hardens &&
                          singular_functions(scene).n == 0),
                       "Creep integral",
                       "needs nonlinear creep without hardening, such as "
                       "[Material] Viscosity = power law, and "
                       "[Discretisation] Singular functions = 0");
      if (!scene.is_axisymmetric())
        return;
      crack_tip.demand(scene.crack_tip.method !=
                         StressIntensityMethod::williams_fit,
                       "Method",
                       "williams fit is not for [Material] Plane state = "
                       "axisymmetric; use automatic");
      crack_tip.demand(!scene.crack_tip.needs_stress_intensity() ||
                         creeps_in_proportion(scene.material),
                       "Stress intensity",
                       "needs, with [Material] Plane state = axisymmetric, an "
                       "isotropic body that creeps with its elastic Poisson's "
                       "ratio: leave Stiffness matrix and Viscosity matrix "
                       "out, and set Viscous Poisson ratio to Poisson ratio, "
                       "or Viscosity = relaxation time or chain, not in shear "
                       "only");
    }



    /** Checks the elements: plane stress needs no mean volumetric strain, the
     * singular functions are those of a plane crack, and B-bar supports only
     * shape functions. */
    void
    check_elements(const Scene &scene, Problems &problems)
    {
      const DiscretisationParameters &discretisation = scene.discretisation;
      const Checker checker(DiscretisationParameters::section, problems);
      const bool    has_mean =
        discretisation.volumetric_strain == VolumetricStrain::mean;
      checker.demand(
        !has_mean || scene.dimension == 3 ||
          scene.material.plane_state != PlaneState::plane_stress,
        "Volumetric strain",
        "is not allowed in plane stress, where elements do not lock; it must "
        "be full, or [Material] Plane state = plane strain");

      const auto [setting, advice] = obstacle_to_singular_functions(scene);
      checker.demand(setting.empty() || singular_functions(scene).n == 0,
                     "Singular functions",
                     "must be 0 with " + setting + advice);
    }



    /** Checks the parameters of the methods of solution. */
    void
    check_methods(const Scene &scene, Problems &problems)
    {
      const PeriodicStateParameters &periodic = scene.periodic_state;
      Checker(ContactParameters::section, problems)
        .demand_valid("Relaxation factor", scene.contact.relaxation_factor);
      Checker(LinearSolverParameters::section, problems)
        .demand(scene.linear_solver.type != LinearSolverType::gmg ||
                  !scene.contact.needs_matrix(),
                "Type",
                "has no matrix, which [Contact] Solver = projected sor and "
                "Relaxation table need; use automatic, cholesky or amg");
      Checker(OutputParameters::section, problems)
        .demand(scene.time_integration.step_control !=
                    StepControlType::adaptive ||
                  scene.output.elastic_comparison == ComparedLip::none,
                "Elastic comparison",
                "must be none with [Time integration] Step control = adaptive: "
                "the comparison needs steps that are known in advance");
      Checker(TimeIntegrationParameters::section, problems)
        .demand(
          scene.material.creep_law() == nullptr ||
            (scene.time_integration.scheme != Scheme::predictor_corrector &&
             scene.time_integration.scheme != Scheme::exponential &&
             scene.time_integration.scheme != Scheme::trapezoid),
          "Scheme",
          "is for linear materials, which [Material] Viscosity = " +
            name_of(scene.material.viscosity) +
            " is not: predictor corrector and exponential work with their "
            "relaxation, and with trapezoid the stress at a crack tip "
            "oscillates instead of relaxing; use another one, such as heun, or "
            "sdirk2 for long steps");
      Checker(PeriodicStateParameters::section, problems)
        .demand(periodic.secular_split != SecularSplitType::off ||
                  (periodic.method != PeriodicMethodType::anderson &&
                   periodic.method != PeriodicMethodType::fourier),
                "Secular split",
                "leaves the secular flow in the viscous strain, which needs "
                "Method = march; otherwise set Secular split = automatic");
    }



    /** Checks the number of coordinates in lists of points. */
    template <int dim>
    void
    check_points(const Scene &scene, Problems &problems)
    {
      if (scene.boundary.fixed_points.is_valid())
        Checker(BoundaryParameters::section, problems)
          .demand_readable("Fixed points", [&]() {
            to_fixed_points<dim>(*scene.boundary.fixed_points);
          });
      Checker(OutputParameters::section, problems)
        .demand_readable("Probes", [&]() {
          for (const NamedPoint &probe : *scene.output.probes)
            to_point<dim>(probe.coordinates);
        });
    }



    /** Checks what changes the mesh, which takes along viscous strain alone. */
    void
    check_change_of_mesh(const Scene &scene, Problems &problems)
    {
      const unsigned int n      = scene.refinement.readapt_every;
      const auto        &growth = scene.geometry.crack_growth;
      const bool         grows  = growth.is_valid() && !growth->empty();
      if (n == 0 && !grows)
        return;
      const auto demand = [&](const bool fulfilled, const std::string &reason) {
        if (n > 0)
          Checker(RefinementParameters::section, problems)
            .demand(fulfilled, "Readapt every", "must be 0 " + reason);
        if (grows)
          Checker(GeometryParameters::section, problems)
            .demand(fulfilled, "Crack growth", "is not possible " + reason);
      };
      demand(n == 0 || !grows, "with both of them");
      demand(scene.periodic_state.missions.empty(),
             "with [Periodic state] Missions, which leap on one mesh");
      demand(!scene.periodic_state.missions.empty() ||
               scene.periodic_state.method == PeriodicMethodType::march,
             "unless [Periodic state] Method = march: other methods compare "
             "states on one mesh");
      demand(scene.periodic_state.secular_split != SecularSplitType::on,
             "with [Periodic state] Secular split = on: each mesh has its own "
             "secular flow");
      demand(scene.material.viscosity != ViscosityType::none,
             "with [Material] Viscosity = none: there is only one period");
      demand(singular_functions(scene).n == 0,
             "with [Discretisation] Singular functions: another mesh cannot "
             "represent the viscous strain that they cause");
      demand(n >= 3 || scene.periodic_state.tolerance == 0.,
             n > 0 ? "or at least 3 with [Periodic state] Tolerance > 0: its "
                     "error is known from the third period on"
                   : "unless [Periodic state] Tolerance = 0");
    }



    void
    check_instants(const Scene &scene, Problems &problems)
    {
      if (problems.concern(LoadParameters::section, "Period"))
        return;
      const double period = scene.loads.period;
      const auto   check  = [&](const char                *section,
                             const char                *name,
                             const std::vector<double> &instants) {
        for (const double instant : instants)
          Checker(section, problems)
            .demand(instant <= period,
                    name,
                    Text::from_number(instant) +
                      " must be within the period: Loads/Period = " +
                      Text::from_number(period));
      };
      if (scene.time_integration.step_control == StepControlType::list)
        check(TimeIntegrationParameters::section,
              "Steps",
              scene.time_integration.steps);
      const auto &field_times = scene.output.field_times;
      Checker(OutputParameters::section, problems)
        .demand_valid("Field times", field_times);
      if (field_times.is_valid())
        check(OutputParameters::section, "Field times", field_times->listed);
      check(RefinementParameters::section,
            "Instants",
            scene.refinement.instants);
    }
  } // namespace



  void
  Scene::add_parameters(dealii::ParameterHandler &prm)
  {
    prm.add_parameter("Title",
                      title,
                      "A line of text for figures and reports.");
    prm.add_parameter("Dimension",
                      dimension,
                      "Dimension of space.",
                      dealii::Patterns::Integer(2, 3));
    prm.add_parameter(
      "Units",
      units,
      "Units of length, stress, time and temperature, which label results and "
      "convert nothing. Empty: not known. Allowed: names as in mm, MPa, h, K");
    prm.add_parameter(
      "Output directory",
      output_directory,
      "Directory of the results. Empty: results/NAME for the scene NAME.prm. A "
      "relative path starts at the working directory. Allowed: a path");

    const auto add = [&prm](auto &parameters) {
      prm.enter_subsection(parameters.section);
      parameters.add_parameters(prm);
      prm.leave_subsection();
    };
    add(geometry);
    add(boundary);
    add(material);
    add(loads);
    add(tables);
    add(discretisation);
    add(refinement);
    add(contact);
    add(linear_solver);
    add(time_integration);
    add(periodic_state);
    add(crack_tip);
    add(output);
  }



  void
  Scene::check(Problems &problems) const
  {
    const Units of_scene(units, &problems);
    geometry.check(problems);
    boundary.check(problems);
    material.check(problems);
    loads.check(problems);
    if (!problems.concern(LoadParameters::section, "Period"))
      tables.check(loads.period, problems);
    discretisation.check(problems);
    refinement.check(problems);
    time_integration.check(problems);
    periodic_state.check(problems);
    crack_tip.check(problems);
    Checker(MaterialParameters::section, problems)
      .demand(material.mean_expansion_from.text().empty() ||
                !loads.reference.text().empty(),
              "Mean expansion from",
              "is a temperature, which needs [Loads] Reference temperature");
    if (problems.concern("", "Dimension"))
      return;
    check_subdivisions(*this, problems);
    check_body(*this, problems);
    check_roles(*this, problems);
    check_elements(*this, problems);
    check_methods(*this, problems);
    check_material(*this, problems);
    if (dimension == 2)
      check_points<2>(*this, problems);
    else
      check_points<3>(*this, problems);
    check_instants(*this, problems);
    check_change_of_mesh(*this, problems);
  }
} // namespace Crevasse
