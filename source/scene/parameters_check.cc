// ---------------------------------------------------------------------
//
// Copyright (C) 2026 by the Crevasse authors
//
// This file is part of Crevasse. It is free software; you can use it,
// redistribute it and/or modify it under the terms of the GNU Lesser
// General Public License as published by the Free Software Foundation;
// either version 2.1 of the License, or (at your option) any later version.
//
// ---------------------------------------------------------------------

#include <crevasse/scene/boundary_roles.h>
#include <crevasse/scene/built_in_boundary.h>
#include <crevasse/scene/expression.h>
#include <crevasse/scene/parameters.h>
#include <crevasse/scene/recorded_steps.h>
#include <crevasse/scene/text.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>

namespace Crevasse
{
  namespace
  {
    /** Adds problems about the parameters of one section. */
    class Checker
    {
    public:
      Checker(const char *section, Problems &problems)
        : section(section)
        , problems(problems)
      {
      }



      void
      demand(const bool         fulfilled,
             const char        *name,
             const std::string &value,
             const std::string &allowed) const
      {
        if (!fulfilled)
          problems.add(section, name, value, allowed);
      }



      void
      demand(const bool         fulfilled,
             const char        *name,
             const double       value,
             const std::string &allowed) const
      {
        // Comparisons are false for NaN, but let infinity pass.
        demand(fulfilled && std::isfinite(value),
               name,
               Text::from_number(value),
               allowed);
      }



      /** A quantity with a unit. Products of four such, as the squares of
       * norms hold, must be numbers that a computer has. */
      void
      demand_positive(const char *name, const double value) const
      {
        demand(value > 0., name, value, "must be greater than 0");
        demand(!(value > 0.) || (value >= 1e-70 && value <= 1e70),
               name,
               value,
               "must be from 1e-70 to 1e70; choose other units");
      }

    private:
      const char *section;
      Problems   &problems;
    };



    /** Over-relaxation converges for these factors only. */
    bool
    is_relaxation_factor(const double value)
    {
      return value > 0. && value < 2.;
    }



    /** Blames Subdivisions only where they are too many by themselves. */
    void
    check_number_of_cells(const GeometryParameters &geometry,
                          const Checker            &checker)
    {
      constexpr double  most = 2e7;
      const std::string why =
        "; more than 2e7 are more than a direct solver can take";

      double                   n_cells = 1.;
      std::vector<std::string> factors;
      for (const unsigned int n : geometry.subdivisions)
        {
          n_cells *= n;
          factors.push_back(std::to_string(n));
        }
      const std::string subdivisions = Text::join(factors, ", ");
      checker.demand(n_cells <= most,
                     "Subdivisions",
                     subdivisions,
                     "makes " + Text::from_number(n_cells) + " cells" + why);

      const double n_refined =
        n_cells *
        std::pow(2., geometry.subdivisions.size() * geometry.refinements);
      checker.demand(n_cells > most || n_refined <= most,
                     "Refinements",
                     std::to_string(geometry.refinements),
                     "makes " + Text::from_number(n_refined) +
                       " cells of Subdivisions = " + subdivisions + why);
    }
  } // namespace



  void
  GeometryParameters::check(Problems &problems) const
  {
    const Checker checker(section, problems);
    checker.demand_positive("Width", width);
    checker.demand_positive("Height", height);
    checker.demand_positive("Thickness", thickness);

    const bool cracked = has_crack(*this);
    if (cracked)
      {
        checker.demand_positive("Crack length", crack_length);
        if (!problems.concern(section, "Width"))
          {
            checker.demand(crack_length < width,
                           "Crack length",
                           crack_length,
                           "must be shorter than the plate: Width = " +
                             Text::from_number(width));
            // Beyond this the cells at the tip vanish in rounding.
            const double shortest = 1e-8 * width;
            checker.demand(crack_length >= width ||
                             (crack_length >= shortest &&
                              width - crack_length >= shortest),
                           "Crack length",
                           crack_length,
                           "crack and ligament must each be at least 1e-8 of "
                           "Width = " +
                             Text::from_number(width));
          }
      }

    for (const unsigned int n : subdivisions)
      checker.demand(n > 0, "Subdivisions", n, "must be at least 1");
    if (cracked && !subdivisions.empty())
      checker.demand(subdivisions[0] != 1,
                     "Subdivisions",
                     subdivisions[0],
                     "must be at least 2 along x, because the crack tip is a "
                     "vertex of the mesh");
    checker.demand(refinements <= 12,
                   "Refinements",
                   refinements,
                   "must be at most 12");

    if (shape != "mesh file" && !problems.concern(section, "Refinements"))
      check_number_of_cells(*this, checker);

    if (shape == "mesh file")
      // A directory can be opened, but nothing can be read from it.
      checker.demand(std::ifstream(mesh_file).peek() !=
                       std::ifstream::traits_type::eof(),
                     "Mesh file",
                     mesh_file,
                     "must be a file that can be read, for the shape is \"mesh "
                     "file\"");
    else
      checker.demand(mesh_file.empty(),
                     "Mesh file",
                     mesh_file,
                     "is allowed only for the shape \"mesh file\"; the shape "
                     "is \"" +
                       shape + "\"");
  }



  void
  BoundaryParameters::check(Problems &problems) const
  {
    const Checker checker(section, problems);

    std::map<dealii::types::boundary_id, std::string> role_of;
    const auto check_ids = [&](const char *name, const std::string &value) {
      try
        {
          const auto ids = parse_boundary_ids(value);
          if (ids)
            for (const auto id : *ids)
              {
                const auto [role, is_new] = role_of.emplace(id, name);
                checker.demand(is_new,
                               name,
                               value,
                               "the boundary id " + std::to_string(id) +
                                 " must have one role only; " + role->second +
                                 " names it as well");
              }
        }
      catch (const SceneError &error)
        {
          problems.add(section, name, value, error.what());
        }
    };
    check_ids("Clamped", clamped);
    check_ids("Symmetry", symmetry);
    check_ids("Loaded", loaded);
    check_ids("Contact", contact);

    try
      {
        const Expression expression(gap);
        checker.demand(!expression.depends_on_time(),
                       "Gap",
                       gap,
                       "must not depend on t");
        if (!expression.depends_on_time() && !expression.depends_on_space())
          checker.demand(expression.value(dealii::Point<2>()) <= 0.,
                         "Gap",
                         gap,
                         "must be at most 0: the lip moves away from the "
                         "crack plane only");
      }
    catch (const SceneError &error)
      {
        problems.add(section, "Gap", gap, error.what());
      }
  }



  void
  LoadParameters::check(Problems &problems) const
  {
    Checker(section, problems).demand_positive("Period", period);

    const auto check_formulas = [&](const char        *name,
                                    const std::string &formulas) {
      for (const std::string &formula : Text::split(formulas, ';'))
        try
          {
            Expression expression(formula);
          }
        catch (const SceneError &error)
          {
            problems.add(section, name, formulas, error.what());
          }
    };
    check_formulas("Traction", traction);
    check_formulas("Body force", body_force);
  }



  void
  DiscretisationParameters::check(Problems &problems) const
  {
    const Checker checker(section, problems);
    checker.demand(degree == 1 || degree == 2,
                   "Degree",
                   degree,
                   "must be 1 or 2");
    checker.demand(volumetric_strain != "mean" || degree == 1,
                   "Volumetric strain",
                   volumetric_strain,
                   "is for linear elements only; with Degree = " +
                     std::to_string(degree) + " it must be full");
  }



  void
  ContactParameters::check(Problems &problems) const
  {
    const Checker checker(section, problems);

    if (relaxation_factor != "automatic")
      checker.demand(is_relaxation_factor(
                       Text::to_number(relaxation_factor).value_or(0.)),
                     "Relaxation factor",
                     relaxation_factor,
                     "must be \"automatic\" or a number greater than 0 and "
                     "less than 2");
    checker.demand(tolerance > 0. && tolerance <= 1e-2,
                   "Tolerance",
                   tolerance,
                   "must be greater than 0 and at most 0.01");
    checker.demand(maximum_iterations >= 1,
                   "Maximum iterations",
                   maximum_iterations,
                   "must be at least 1");
    for (const double factor : relaxation_table)
      checker.demand(is_relaxation_factor(factor),
                     "Relaxation table",
                     factor,
                     "must be greater than 0 and less than 2");
  }



  void
  LinearSolverParameters::check(Problems &problems) const
  {
    const Checker checker(section, problems);
    checker.demand(tolerance > 0. && tolerance <= 0.1,
                   "Tolerance",
                   tolerance,
                   "must be greater than 0 and at most 0.1");
    checker.demand(memory_for_instants >= 0.,
                   "Memory for instants",
                   memory_for_instants,
                   "must be at least 0");
  }



  void
  TimeIntegrationParameters::check(Problems &problems) const
  {
    const Checker checker(section, problems);
    if (scheme == "heun")
      checker.demand(heun_weight >= 0.5 && heun_weight <= 1.,
                     "Heun weight",
                     heun_weight,
                     "must be from 0.5, which puts the second stage at the "
                     "end of the step, to 1");
    checker.demand(steps_per_period >= 1 && steps_per_period <= 1000000,
                   "Steps per period",
                   steps_per_period,
                   "must be from 1 to 1000000");

    if (step_control != "list")
      return;
    checker.demand(!steps.empty(),
                   "Steps",
                   "",
                   "must be given, for the step control is \"list\"");
    for (std::size_t i = 0; i < steps.size(); ++i)
      {
        checker.demand(steps[i] >= 0., "Steps", steps[i], "must be at least 0");
        if (i > 0)
          checker.demand(steps[i] > steps[i - 1],
                         "Steps",
                         steps[i],
                         "must be later than the instant before it, " +
                           Text::from_number(steps[i - 1]));
      }
  }



  void
  PeriodicStateParameters::check(Problems &problems) const
  {
    Checker(section, problems)
      .demand(tolerance >= 0. && tolerance < 1.,
              "Tolerance",
              tolerance,
              "must be at least 0 and less than 1");
  }



  void
  OutputParameters::check(Problems &problems) const
  {
    const Checker checker(section, problems);
    for (const double time : field_times)
      checker.demand(time >= 0., "Field times", time, "must be at least 0");
    try
      {
        parse_recorded_steps(contact_problems);
      }
    catch (const SceneError &error)
      {
        problems.add(section,
                     "Contact problems",
                     contact_problems,
                     error.what());
      }
  }
} // namespace Crevasse
