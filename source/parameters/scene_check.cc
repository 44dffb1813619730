// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/text.h>
#include <crevasse/parameters/boundary_roles.h>
#include <crevasse/parameters/checker.h>
#include <crevasse/parameters/scene.h>

namespace Crevasse
{
  namespace
  {
    /** The bodies without a crack have different names. */
    void
    check_shape(const Scene &scene, Problems &problems)
    {
      const bool  plane    = scene.dimension == 2;
      const Shape allowed  = plane ? Shape::rectangle : Shape::box;
      const Shape excluded = plane ? Shape::box : Shape::rectangle;
      if (scene.geometry.shape == excluded)
        problems.add(GeometryParameters::section,
                     "Shape",
                     name_of(excluded),
                     "is not allowed with Dimension = " +
                       std::to_string(scene.dimension) +
                       ": the body without a crack is \"" + name_of(allowed) +
                       "\" there");
    }



    /** In plane stress the thickness makes room for any change of area. */
    void
    check_volumetric_strain(const Scene &scene, Problems &problems)
    {
      if (scene.discretisation.volumetric_strain == VolumetricStrain::mean &&
          scene.dimension == 2 &&
          scene.material.plane_state == PlaneState::plane_stress)
        problems.add(DiscretisationParameters::section,
                     "Volumetric strain",
                     "mean",
                     "is not allowed in plane stress, where no volume is kept "
                     "and nothing locks; it must be full, or [Material] Plane "
                     "state = plane strain");
    }



    /** The singular functions are those of a plane crack, and B-bar knows only
     * shape functions. */
    void
    check_singular_functions(const Scene &scene, Problems &problems)
    {
      const DiscretisationParameters &discretisation = scene.discretisation;
      const Checker checker(DiscretisationParameters::section, problems);
      checker.demand(discretisation.singular_functions == 0 ||
                       scene.dimension == 2,
                     "Singular functions",
                     discretisation.singular_functions,
                     "must be 0 with Dimension = 3: they are those of a crack "
                     "tip in the plane; use [Refinement] Strategy = tip");
      checker.demand(discretisation.singular_functions == 0 ||
                       discretisation.volumetric_strain ==
                         VolumetricStrain::full,
                     "Singular functions",
                     discretisation.singular_functions,
                     "must be 0 with Volumetric strain = mean; use Degree = 2 "
                     "instead of mean dilatations");
      checker.demand(
        discretisation.singular_functions == 0 ||
          !traits(scene.linear_solver.type).is_multigrid,
        "Singular functions",
        discretisation.singular_functions,
        "must be 0 with [Linear solver] Type = " +
          name_of(scene.linear_solver.type) +
          ": they couple all unknowns; use automatic, cholesky or mumps");
      checker.demand(discretisation.singular_functions == 0 ||
                       !scene.boundary.gap.is_valid() ||
                       scene.boundary.gap->is_zero(),
                     "Singular functions",
                     discretisation.singular_functions,
                     "must be 0 with [Boundary] Gap = " +
                       scene.boundary.gap.text() +
                       ": a crack that is open without load may close at its "
                       "tip, which the bound of the singular function forbids");
    }



    /** Projected SOR needs the entries of a matrix. */
    void
    check_matrix_free(const Scene &scene, Problems &problems)
    {
      const bool relaxes = traits(scene.contact.solver).relaxes ||
                           !scene.contact.relaxation_table.empty();
      Checker(LinearSolverParameters::section, problems)
        .demand(scene.linear_solver.type != LinearSolverType::gmg || !relaxes,
                "Type",
                name_of(scene.linear_solver.type),
                "has no matrix, which [Contact] Solver = projected sor and "
                "Relaxation table need; use automatic, cholesky or amg");
    }



    void
    check_crack_tip(const Scene &scene, Problems &problems)
    {
      Checker(CrackTipParameters::section, problems)
        .demand(!scene.crack_tip.stress_intensity || scene.dimension == 2,
                "Stress intensity",
                "true",
                "is for Dimension = 2: in space K varies along the front");
    }



    /** Formulas and mesh sizes: one for each dimension. */
    void
    check_components(const Scene &scene, Problems &problems)
    {
      const std::string dimension = std::to_string(scene.dimension);

      const auto &subdivisions = scene.geometry.subdivisions;
      if (scene.geometry.shape != Shape::mesh_file &&
          subdivisions.size() != scene.dimension)
        {
          std::vector<std::string> parts;
          for (const unsigned int n : subdivisions)
            parts.push_back(std::to_string(n));
          problems.add(GeometryParameters::section,
                       "Subdivisions",
                       Text::join(parts, ", "),
                       "must be " + dimension +
                         " integers, one for each dimension");
        }

      const auto check_formulas = [&](const char     *name,
                                      const Formulas &formulas) {
        const std::size_t n = Text::split(formulas.text(), ';').size();
        if (n != 0 && n != scene.dimension)
          problems.add(LoadParameters::section,
                       name,
                       formulas.text(),
                       "must be " + dimension +
                         " formulas, one for each dimension, separated by "
                         "semicolons, or nothing");
      };
      check_formulas("Traction", scene.loads.traction);
      check_formulas("Body force", scene.loads.body_force);
    }



    /** Matrices and tensors, whose size is that of the dimension. Whether
     * their entries are formulas the section knows. */
    void
    check_tensors(const Scene &scene, Problems &problems)
    {
      const MaterialParameters &material = scene.material;
      const bool                plane_stress =
        material.plane_state == PlaneState::plane_stress;
      const auto check =
        [&](const char *name, const auto &value, const auto &...more) {
          if (!problems.concern(MaterialParameters::section, name))
            Checker(MaterialParameters::section, problems)
              .demand_readable(name, value.text(), [&]() {
                require_size(value, scene.dimension, more...);
              });
        };
      if (!material.stiffness_matrix.text().empty())
        check("Stiffness matrix", material.stiffness_matrix, plane_stress);
      if (material.viscosity == ViscosityType::matrix)
        check("Viscosity matrix", material.viscosity_matrix, plane_stress);
      for (const auto &strain : material.free_strains())
        check(strain.parameter, strain.components);
    }



    /** The lists of points, whose number of coordinates is the dimension. */
    template <int dim>
    void
    check_points(const Scene &scene, Problems &problems)
    {
      const std::string &fixed_points = scene.boundary.fixed_points;
      const auto        &probes       = scene.output.probes;
      Checker(BoundaryParameters::section, problems)
        .demand_readable("Fixed points", fixed_points, [&]() {
          parse_fixed_points<dim>(fixed_points);
        });
      Checker(OutputParameters::section, problems)
        .demand_readable("Probes", probes.text(), [&]() {
          to_probes<dim>(*probes);
        });
    }



    /** What knows the steps in advance. */
    void
    check_fixed_steps(const Scene &scene, Problems &problems)
    {
      if (scene.time_integration.step_control == StepControlType::adaptive)
        Checker(OutputParameters::section, problems)
          .demand(scene.output.elastic_comparison == ComparedLip::none,
                  "Elastic comparison",
                  name_of(scene.output.elastic_comparison),
                  "compares at steps that are known in advance: with [Time "
                  "integration] Step control = adaptive it must be none");
    }



    /** What needs a viscous strain that is periodic. */
    void
    check_secular_split(const Scene &scene, Problems &problems)
    {
      const PeriodicStateParameters &periodic = scene.periodic_state;
      Checker(PeriodicStateParameters::section, problems)
        .demand(periodic.secular_split != SecularSplitType::off ||
                  (periodic.method != PeriodicMethodType::anderson &&
                   periodic.method != PeriodicMethodType::fourier &&
                   periodic.start_from != StartFrom::fourier),
                "Secular split",
                name_of(periodic.secular_split),
                "leaves what flows in the viscous strain, which only Method = "
                "march from rest can do with; set it to automatic");
    }



    /** The mesh can change only where nothing but the viscous strain goes on
     * from one period to the next. */
    void
    check_readaptation(const Scene &scene, Problems &problems)
    {
      const unsigned int n = scene.refinement.readapt_every;
      if (n == 0)
        return;
      const auto demand = [&](const bool fulfilled, const std::string &reason) {
        Checker(RefinementParameters::section, problems)
          .demand(fulfilled,
                  "Readapt every",
                  std::to_string(n),
                  "must be 0 " + reason);
      };
      demand(scene.periodic_state.method == PeriodicMethodType::march,
             "unless [Periodic state] Method = march: other methods compare "
             "states on one mesh");
      demand(scene.periodic_state.start_from == StartFrom::rest,
             "with [Periodic state] Start from = " +
               name_of(scene.periodic_state.start_from) +
               ": a march that begins anew goes on from its own state");
      demand(scene.periodic_state.secular_split != SecularSplitType::on,
             "with [Periodic state] Secular split = on: each mesh has its own "
             "flow");
      demand(scene.material.viscosity != ViscosityType::none,
             "with [Material] Viscosity = none: there is only one period");
      demand(scene.discretisation.singular_functions == 0,
             "with [Discretisation] Singular functions: what they have caused "
             "in the viscous strain does not go over to another mesh");
      demand(n >= 3 || scene.periodic_state.tolerance == 0.,
             "or at least 3 with [Periodic state] Tolerance > 0: on each mesh "
             "the error of the stress is known from the third period on");
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
          if (instant > period)
            problems.add(section,
                         name,
                         Text::from_number(instant),
                         "must be within the period: Loads/Period = " +
                           Text::from_number(period));
      };
      if (scene.time_integration.step_control == StepControlType::list)
        check(TimeIntegrationParameters::section,
              "Steps",
              scene.time_integration.steps);
      check(OutputParameters::section, "Field times", scene.output.field_times);
      check(RefinementParameters::section,
            "Instants",
            scene.refinement.instants);
    }

  } // namespace



  void
  Scene::check(Problems &problems) const
  {
    geometry.check(problems);
    boundary.check(problems);
    material.check(problems);
    loads.check(problems);
    discretisation.check(problems);
    refinement.check(problems);
    contact.check(problems);
    linear_solver.check(problems);
    time_integration.check(problems);
    periodic_state.check(problems);
    crack_tip.check(problems);
    output.check(problems);

    if (dimension != 2 && dimension != 3)
      {
        problems.add("",
                     "Dimension",
                     std::to_string(dimension),
                     "must be 2 or 3");
        return;
      }
    check_shape(*this, problems);
    check_volumetric_strain(*this, problems);
    check_singular_functions(*this, problems);
    check_matrix_free(*this, problems);
    check_crack_tip(*this, problems);
    check_components(*this, problems);
    check_tensors(*this, problems);
    if (dimension == 2)
      check_points<2>(*this, problems);
    else
      check_points<3>(*this, problems);
    check_instants(*this, problems);
    check_fixed_steps(*this, problems);
    check_secular_split(*this, problems);
    check_readaptation(*this, problems);
  }
} // namespace Crevasse
