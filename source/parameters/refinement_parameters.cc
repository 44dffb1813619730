// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/parameters/checker.h>
#include <crevasse/parameters/refinement_parameters.h>

#include <deal.II/base/patterns.h>

namespace Crevasse
{
  using namespace dealii;

  void
  RefinementParameters::add_parameters(ParameterHandler &prm)
  {
    add_selection("Strategy", strategy, prm);
    prm.add_parameter("Target unknowns",
                      target_unknowns,
                      "Refinement ends before the mesh has more unknowns; 0: "
                      "no limit. Allowed: an integer, at least 0",
                      Patterns::Integer(0));
    prm.add_parameter(
      "Cycles",
      cycles,
      "How often the cells around the tip are divided, or how many meshes "
      "follow on the first one; 0: until Target unknowns or Tolerance. "
      "Allowed: an integer, at least 0",
      Patterns::Integer(0));
    add_selection("Marking", marking, prm);
    prm.add_parameter("Refine fraction",
                      refine_fraction,
                      "The cells of the largest errors with this part of the "
                      "whole are divided. Allowed: greater than 0, at most 1",
                      Patterns::Double());
    prm.add_parameter("Coarsen fraction",
                      coarsen_fraction,
                      "The cells of the smallest errors with this part of the "
                      "whole are joined. Allowed: at least 0, less than 1",
                      Patterns::Double());
    prm.add_parameter(
      "Tolerance",
      tolerance,
      "Estimated error of the stress, relative to the stress (both in the "
      "energy norm), at which adaptive refinement ends; 0: none. Allowed: at "
      "least 0, less than 1",
      Patterns::Double());
    prm.add_parameter(
      "Instants",
      instants,
      "Instants within the period whose errors count, the largest of each "
      "cell; nothing: that of the largest load and that of the most opposite "
      "one, if there is an opposite one. In units of time. Allowed: numbers "
      "from 0 to the period, separated by commas");
    prm.add_parameter(
      "Readapt every",
      readapt_every,
      "Number of periods after which the mesh is adapted anew to the stress "
      "of the last of them; 0: never. Allowed: an "
      "integer, at least 0",
      Patterns::Integer(0));
  }



  void
  RefinementParameters::check(Problems &problems) const
  {
    const Checker checker(section, problems);
    checker.demand(refine_fraction > 0. && refine_fraction <= 1.,
                   "Refine fraction",
                   refine_fraction,
                   "must be greater than 0 and at most 1");
    checker.demand(coarsen_fraction >= 0. &&
                     coarsen_fraction + refine_fraction <= 1.,
                   "Coarsen fraction",
                   coarsen_fraction,
                   "must be at least 0 and, with Refine fraction, at most 1");
    checker.demand(tolerance >= 0. && tolerance < 1.,
                   "Tolerance",
                   tolerance,
                   "must be at least 0 and less than 1");
    for (const double instant : instants)
      checker.demand(instant >= 0., "Instants", instant, "must be at least 0");
    // Each level halves the cells: 2^-40 is at the rounding of coordinates.
    checker.demand(strategy != RefinementStrategy::tip || cycles <= 40,
                   "Cycles",
                   cycles,
                   "must be at most 40 with Strategy = tip: each divides the "
                   "size of the cells at the tip by 2");
    checker.demand(strategy != RefinementStrategy::tip || cycles > 0 ||
                     target_unknowns > 0,
                   "Strategy",
                   name_of(strategy),
                   "needs Cycles or Target unknowns to be greater than 0: "
                   "otherwise it would not end");
    checker.demand(strategy != RefinementStrategy::adaptive || cycles > 0 ||
                     target_unknowns > 0 || tolerance > 0.,
                   "Strategy",
                   name_of(strategy),
                   "needs Cycles, Target unknowns or Tolerance to be greater "
                   "than 0: otherwise it would not end");
    checker.demand(readapt_every == 0 ||
                     strategy == RefinementStrategy::adaptive,
                   "Readapt every",
                   readapt_every,
                   "is for Strategy = adaptive; otherwise it must be 0");
  }
} // namespace Crevasse
