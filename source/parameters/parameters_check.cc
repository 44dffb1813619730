// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/text_file.h>
#include <crevasse/parameters/checker.h>
#include <crevasse/parameters/parameters.h>

#include <filesystem>

namespace Crevasse
{
  namespace
  {
    /** Adds a problem unless a file exists, is readable and is not empty.
     * @param advice where it cannot be read. */
    void
    demand_file(const char        *section,
                const char        *name,
                const std::string &file_name,
                Problems          &problems,
                const std::string &advice = "")
    {
      std::error_code no_size; // pipes have no size
      if (Checker(section, problems).demand_file(name, file_name, advice) &&
          std::filesystem::file_size(file_name, no_size) == 0 && !no_size)
        problems.add(section, name, file_name, "is empty");
    }



    void
    check_crack_length(const GeometryParameters &geometry,
                       const Checker            &checker)
    {
      const double      width = geometry.width, length = geometry.crack_length;
      const std::string of_width = "Width = " + Text::from_number(width);
      checker.demand(length < width,
                     "Crack length",
                     "must be shorter than the plate: " + of_width);
      // For shorter lengths, the cells at the tip vanish in rounding.
      const double shortest = 1e-8 * width;
      checker.demand(length >= width ||
                       (length >= shortest && width - length >= shortest),
                     "Crack length",
                     "crack and ligament must each be at least 1e-8 of " +
                       of_width);
    }
    void
    check_crack_growth(const GeometryParameters &geometry,
                       const Checker            &checker)
    {
      checker.demand_valid("Crack growth", geometry.crack_growth);
      if (!geometry.crack_growth.is_valid() || geometry.crack_growth->empty())
        return;
      checker.demand(traits(geometry.shape).has_crack,
                     "Crack growth",
                     "needs a shape with a built-in crack");
      double before = geometry.crack_length;
      for (const auto &[periods, length] : *geometry.crack_growth)
        {
          checker.demand(length > before && length < geometry.width,
                         "Crack growth",
                         "after " + std::to_string(periods) +
                           " periods the length " + Text::from_number(length) +
                           " must be greater than " +
                           Text::from_number(before) +
                           " and less than Width = " +
                           Text::from_number(geometry.width));
          before = length;
        }
    }
  } // namespace



  void
  GeometryParameters::check(Problems &problems) const
  {
    const Checker checker(section, problems);
    check_crack_growth(*this, checker);
    if (traits(shape).has_crack && !problems.concern(section, "Width") &&
        !problems.concern(section, "Crack length"))
      check_crack_length(*this, checker);
    if (shape != Shape::mesh_file)
      checker.demand(mesh_file.empty(),
                     "Mesh file",
                     "is allowed only with Shape = mesh file; the shape is \"" +
                       name_of(shape) + "\"");
    else if (mesh_file.empty())
      checker.demand(false,
                     "Mesh file",
                     "must be given with Shape = mesh file");
    else
      demand_file(section,
                  "Mesh file",
                  mesh_file,
                  problems,
                  ". If a script or a .geo file makes it, as the scene's "
                  "comments may tell, run that first");
  }



  void
  BoundaryParameters::check(Problems &problems) const
  {
    const Checker checker(section, problems);

    std::map<dealii::types::boundary_id, std::string> role_of;
    for (const BoundaryRole &role : boundary_role_table)
      {
        const Parsed<BoundaryList> &list = this->*role.list;
        checker.demand_valid(role.name, list);
        if (!list.is_valid())
          continue;
        checker.demand(list->names.empty(),
                       role.name,
                       "names of boundaries need a mesh file with named "
                       "groups; otherwise this must be \"automatic\", \"none\" "
                       "or boundary ids separated by commas");
        for (const auto id : list->ids)
          {
            const auto [first, is_new] = role_of.emplace(id, role.name);
            checker.demand(is_new || (role.is_lip && first->second == "Loaded"),
                           role.name,
                           "the boundary id " + std::to_string(id) +
                             " must have one role only, but " + first->second +
                             " names it as well");
            first->second = role.name;
          }
      }
    checker.demand_valid("Fixed points", fixed_points);
    checker.demand_valid("Gap", gap);
    checker.demand_valid("Friction coefficient", friction);
  }



  void
  PeriodicStateParameters::check(Problems &problems) const
  {
    const Checker checker(section, problems);
    const auto   &quantity = converged_quantity;
    checker.demand(quantity == "stress" || quantity == "K_I" ||
                     quantity == "opening" || quantity.rfind("probe ", 0) == 0,
                   "Converged quantity",
                   "= " + quantity +
                     " must be stress, K_I, opening, or probe and the name of "
                     "a probe");
    checker.demand(std::is_sorted(missions.begin(),
                                  missions.end(),
                                  std::less_equal<>()),
                   "Missions",
                   "must increase, as in 10, 100, 1000");
    checker.demand(missions.empty() ||
                     method == PeriodicMethodType::automatic ||
                     method == PeriodicMethodType::averaged,
                   "Missions",
                   "needs the averaged body: set Method = automatic or "
                   "averaged");
    checker.demand(missions.empty() || secular_split != SecularSplitType::on,
                   "Missions",
                   "follow the motion from rest, with its flow: set Secular "
                   "split = automatic or off");
  }



  std::vector<ChainBranch>
  MaterialParameters::branches() const
  {
    std::vector<std::string> shifted;
    for (const std::string &body : Text::split(chain.text(), ';'))
      if (const std::size_t time = body.find(':') + 1; time > 0)
        shifted.push_back(body.substr(0, time) + '(' + body.substr(time) +
                          ")*(" + chain_shift.text() + ')');
    return chain_shift.text() == "1" ? *chain
                                     : chain_parser()(Text::join(shifted, ";"));
  }



  void
  MaterialParameters::check(Problems &problems) const
  {
    const Checker checker(section, problems);
    if (stiffness_matrix.text().empty())
      {
        checker.demand_valid("Young modulus", young_modulus);
        checker.demand_valid("Poisson ratio", poisson_ratio);
      }
    checker.demand_valid("Stiffness matrix", stiffness_matrix);
    checker.demand_valid("Stiffness time factor", stiffness_time_factor);
    checker.demand_valid("Viscosity time factor", viscosity_time_factor);
    checker.demand_valid("Mean expansion from", mean_expansion_from);
    for (const FreeStrain &strain : free_strains())
      checker.demand_valid(strain.parameter, strain.components);

    switch (viscosity)
      {
        case ViscosityType::relaxation_time:
          checker.demand_valid("Relaxation time", relaxation_time);
          break;
        case ViscosityType::isotropic:
          checker.demand_valid("Viscous modulus", viscous_modulus);
          checker.demand_valid("Viscous Poisson ratio", viscous_poisson_ratio);
          break;
        case ViscosityType::matrix:
          checker.demand_valid("Viscosity matrix", viscosity_matrix);
          checker.demand(
            !viscosity_matrix.text().empty(),
            "Viscosity matrix",
            "must be given with Viscosity = matrix: rows separated by "
            "semicolons, as 9, 2, 0; 2, 9, 0; 0, 0, 3 (plane stress)");
          break;
        case ViscosityType::chain:
          checker.demand_valid("Chain", chain);
          checker.demand_valid("Chain shift", chain_shift);
          checker.demand(!chain.text().empty(),
                         "Chain",
                         "must be given with Viscosity = chain: a list such as "
                         "0.5: 10; 0.3: 100");
          checker.demand(!chain_in_shear_only ||
                           stiffness_matrix.text().empty(),
                         "Chain in shear only",
                         "needs Young modulus and Poisson ratio instead of "
                         "Stiffness matrix, which may not have a bulk modulus");
          break;
        default:
          break;
      }
    if (const CreepLaw *law = creep_law())
      for (const CreepLawParameter &parameter : law->parameters)
        {
          const Formula &formula = of_creep.at(parameter.name);
          checker.demand_valid(parameter.name, formula);
          const bool is_m =
            law->hardens && &parameter == &law->parameters.back();
          checker.demand(!is_m || !formula.is_valid() ||
                           !(formula->depends_on("t") ||
                             formula->depends_on("theta")),
                         parameter.name,
                         "must not depend on t or theta");
        }
  }



  void
  LoadParameters::check(Problems &problems) const
  {
    const Checker checker(section, problems);
    for (const Force &force : forces())
      checker.demand_valid(force.parameter, force.values);
    checker.demand_valid("Displacement", displacement);
    checker.demand_valid("Displacement rate", displacement_rate);
    checker.demand_valid("Temperature", temperature);
    checker.demand_valid("Reference temperature", reference);
    checker.demand(reference.text().empty() || temperature.text() != "0",
                   "Reference temperature",
                   "needs the absolute temperature in Temperature");
    if (temperature.is_valid() && !*temperature)
      demand_file(section, "Temperature", temperature.text(), problems);
  }



  void
  DiscretisationParameters::check(Problems &problems) const
  {
    Checker(section, problems)
      .demand(volumetric_strain != VolumetricStrain::mean || degree == 1,
              "Volumetric strain",
              "is for linear elements only: set Degree = 1, or Volumetric "
              "strain = full");
  }



  std::optional<double>
  parse_relaxation_factor(const std::string &text)
  {
    if (text == "automatic")
      return {};
    const auto factor = Text::to_number(text);
    if (!factor || !relaxation_factors.contains(*factor))
      throw SceneError("must be \"automatic\" or a number " +
                       std::string(relaxation_factors.words));
    return factor;
  }



  void
  TimeIntegrationParameters::check(Problems &problems) const
  {
    const Checker checker(section, problems);
    if (step_control == StepControlType::adaptive)
      {
        checker.demand(relative_tolerance > 0. || absolute_tolerance > 0.,
                       "Relative tolerance",
                       "must be greater than 0 with Step control = adaptive, "
                       "unless Absolute tolerance is");
        checker.demand(traits(scheme).has(Trait::estimates_error),
                       "Scheme",
                       "has no estimate of the error of its steps, which Step "
                       "control = adaptive needs; use heun, exponential, "
                       "sdirk2, arkode explicit or arkode implicit");
      }
    if (step_control == StepControlType::uniform)
      return;
    checker.demand(step_control != StepControlType::list || !steps.empty(),
                   "Steps",
                   "must be given with Step control = list");
    // A step between instants that differ by rounding only would be noise.
    const double shortest = steps.empty() ? 0. : 1e-12 * steps.back();
    for (std::size_t i = 0; i < steps.size(); ++i)
      if (const double before = i == 0 ? 0. : steps[i - 1];
          !(steps[i] - before > shortest || (i == 0 && steps[i] == 0.)))
        checker.demand(false,
                       "Steps",
                       Text::from_number(steps[i]) +
                         " must be later than the previous instant, " +
                         Text::from_number(before) + ", by more than rounding");
  }



  void
  RefinementParameters::check(Problems &problems) const
  {
    const Checker checker(section, problems);
    const bool    tip      = strategy == RefinementStrategy::tip;
    const bool    adaptive = strategy == RefinementStrategy::adaptive;
    const bool    ends     = cycles > 0 || target_unknowns > 0;
    checker.demand(coarsen_fraction + refine_fraction <= 1.,
                   "Coarsen fraction",
                   "plus Refine fraction must be at most 1");
    // Each level halves the cells: 2^-40 is at the rounding of coordinates.
    checker.demand(!tip || cycles <= 40,
                   "Cycles",
                   "must be at most 40 with Strategy = tip: each cycle halves "
                   "the cells at the tip");
    checker.demand(!tip || ends,
                   "Strategy",
                   "needs Cycles or Target unknowns greater than 0: otherwise "
                   "refinement would not end");
    checker.demand(!adaptive || ends || tolerance > 0.,
                   "Strategy",
                   "needs Cycles, Target unknowns or Tolerance greater than 0: "
                   "otherwise refinement would not end");
    checker.demand(readapt_every == 0 || adaptive,
                   "Readapt every",
                   "is for Strategy = adaptive; otherwise it must be 0");
  }
} // namespace Crevasse
