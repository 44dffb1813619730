// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/text.h>
#include <crevasse/model/body.h>
#include <crevasse/parameters/built_in_boundary.h>
#include <crevasse/study/advise_candidates.h>

#include <algorithm>

namespace Crevasse
{
  namespace
  {
    constexpr unsigned int n_levels_in_time  = 9;
    constexpr unsigned int n_levels_in_space = 7;
    // Other reasons than cells that are too large do not pass, and each level
    // takes longer to be refused.
    constexpr unsigned int refusals_in_space = 2;



    bool
    has_lip(const Scene &scene)
    {
      return !boundary_roles(scene).contact.empty();
    }



    AdviseFamily
    equal_steps(const Scene       &scene,
                const std::string &scheme,
                const bool         locate_events)
    {
      AdviseFamily family;
      family.text = scheme + (locate_events ? " with located events" : "");
      family.refusals_that_pass = n_levels_in_time;
      for (unsigned int level = 0; level < n_levels_in_time; ++level)
        {
          const std::string n = std::to_string(fewest_steps(scene) << level);
          AdviseCandidate   candidate;
          candidate.name     = scheme + "_" + n;
          candidate.scheme   = scheme;
          candidate.text     = family.text + ", " + n + " steps a period";
          candidate.settings = {
            advised("Time integration/Scheme=" + scheme),
            advised("Time integration/Step control=uniform"),
            advised("Time integration/Steps per period=" + n),
            advised(std::string("Time integration/Locate contact events=") +
                    (locate_events ? "true" : "false"))};
          // They belong to other step controls.
          if (!scene.time_integration.steps.empty())
            candidate.settings.push_back(advised("Time integration/Steps="));
          family.candidates.push_back(candidate);
        }
      return family;
    }



    /** Steps by tolerance, with samples at equal distances. */
    AdviseFamily
    steps_by_tolerance(const Scene &scene)
    {
      const std::string samples = std::to_string(2 * fewest_steps(scene));
      const bool        events  = has_lip(scene);
      AdviseFamily      family;
      family.text   = "arkode implicit";
      family.growth = 1.5;
      for (unsigned int level = 0; level < n_levels_in_time; ++level)
        {
          const std::string tolerance =
            Text::from_number(1e-2 / (1 << (2 * level)));
          AdviseCandidate candidate;
          candidate.name   = "arkode_" + tolerance;
          candidate.scheme = "arkode implicit";
          candidate.text   = family.text + ", relative tolerance " + tolerance;
          candidate.settings = {
            advised("Time integration/Scheme=arkode implicit"),
            advised("Time integration/Order=4"),
            advised("Time integration/Step control=adaptive"),
            advised("Time integration/Steps per period=" + samples),
            advised("Time integration/Relative tolerance=" + tolerance),
            advised(std::string("Time integration/Locate contact events=") +
                    (events ? "true" : "false"))};
          family.candidates.push_back(candidate);
        }
      return family;
    }



    /** How the cells of a family are divided at a level. */
    struct Division
    {
      const char  *strategy;
      unsigned int first_cycles, cycles_a_level;
      bool         halve;
    };

    constexpr Division uniform{"none", 0, 0, true};
    // Each division at the tip halves the error that it leaves. A level divides
    // by four what cells of degree 1 leave elsewhere, by eight those of
    // degree 2.
    constexpr Division graded[] = {{"tip", 4, 1, true}, {"tip", 6, 2, true}};
    constexpr Division adapted{"adaptive", 4, 4, false};



    AdviseFamily
    meshes(const unsigned int dimension,
           const unsigned int degree,
           const unsigned int n_functions,
           const Division    &division)
    {
      const bool graded  = division.strategy == std::string("tip"),
                 adapted = division.strategy == std::string("adaptive");
      AdviseFamily family;
      family.text = "degree " + std::to_string(degree) +
                    (graded            ? ", graded to the tip"
                     : adapted         ? ", adaptive mesh"
                     : n_functions > 0 ? ", singular functions"
                                       : "");
      family.growth             = adapted ? 3. : dimension == 2 ? 4. : 8.;
      family.halves_cells       = !graded && !adapted && n_functions == 0;
      family.refusals_that_pass = division.halve ? refusals_in_space : 0;
      for (unsigned int level = 0; level < n_levels_in_space; ++level)
        {
          const std::string refinements =
            std::to_string(division.halve ? level : 0);
          const std::string cycles = std::to_string(
            division.first_cycles + level * division.cycles_a_level);
          AdviseCandidate candidate;
          candidate.name =
            "q" + std::to_string(degree) +
            (n_functions > 0 ? "_singular" : "") +
            (adapted ? "_adaptive_" + cycles : "_" + refinements) +
            (graded ? "_tip_" + cycles : "");
          candidate.text = family.text +
                           (adapted ? " in " + cycles + " cycles"
                                    : (division.halve && level > 0
                                         ? ", refined " + refinements +
                                             (level == 1 ? " time" : " times")
                                         : "")) +
                           (graded ? " in " + cycles + " cycles" : "");
          candidate.settings = {
            advised("Discretisation/Degree=" + std::to_string(degree)),
            advised("Discretisation/Singular functions=" +
                    std::to_string(n_functions)),
            advised("Geometry/Refinements=" + refinements),
            advised(std::string("Refinement/Strategy=") + division.strategy),
            advised("Refinement/Cycles=" + cycles),
            advised("Refinement/Target unknowns=0"),
            advised("Refinement/Tolerance=0"),
            advised("Refinement/Readapt every=0")};
          family.candidates.push_back(candidate);
        }
      return family;
    }
  } // namespace



  Override
  advised(const std::string &assignment)
  {
    return {assignment, "advise"};
  }



  unsigned int
  fewest_steps(const Scene &scene)
  {
    // Ten samples a period are the fewest that show a history; where the number
    // of the scene's steps is a multiple of a little more, that is kept, for
    // loads may jump at the ends of these.
    constexpr unsigned int fewest = 10;
    if (scene.time_integration.step_control == StepControlType::uniform)
      for (unsigned int n = fewest; n < 2 * fewest; ++n)
        if (scene.time_integration.steps_per_period % n == 0)
          return n;
    return fewest;
  }



  std::vector<AdviseFamily>
  families_in_time(const Scene &scene)
  {
    const bool contact = has_lip(scene);
    return {equal_steps(scene, "heun", false),
            equal_steps(scene, "rk4", contact),
            equal_steps(scene, "sdirk2", false),
            equal_steps(scene, "trapezoid", false),
            steps_by_tolerance(scene)};
  }



  const AdviseFamily &
  family_of(const std::string &scheme, const std::vector<AdviseFamily> &in_time)
  {
    return *std::find_if(in_time.begin(),
                         in_time.end(),
                         [&](const AdviseFamily &family) {
                           return family.candidates.front().scheme == scheme;
                         });
  }



  std::vector<AdviseFamily>
  families_in_space(const Scene &scene)
  {
    const unsigned int        dim      = scene.dimension;
    std::vector<AdviseFamily> families = {meshes(dim, 1, 0, uniform),
                                          meshes(dim, 2, 0, uniform)};
    if (has_lip(scene))
      for (const unsigned int degree : {1, 2})
        families.push_back(meshes(dim, degree, 0, graded[degree - 1]));
    if (has_lip(scene) && dim == 2)
      for (const unsigned int degree : {1, 2})
        families.push_back(meshes(dim, degree, 2, uniform));
    if (dim == 2)
      families.push_back(meshes(dim, 2, 0, adapted));
    return families;
  }
} // namespace Crevasse
