// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/range.h>
#include <crevasse/parameters/checker.h>
#include <crevasse/parameters/refinement_parameters.h>

namespace Crevasse
{
  void
  RefinementParameters::add_parameters(dealii::ParameterHandler &prm)
  {
    const dealii::Patterns::Integer count(0);
    const NumberPattern             fraction(Ranges::fraction);
    add_selection("Strategy", strategy, prm);
    prm.add_parameter("Target unknowns",
                      target_unknowns,
                      "Refinement ends before the mesh has more unknowns; 0: "
                      "no limit.",
                      count);
    prm.add_parameter(
      "Cycles",
      cycles,
      "How often the cells around the tip are divided, or how many meshes "
      "follow on the first one; 0: until Target unknowns or Tolerance.",
      count);
    add_selection("Marking", marking, prm);
    prm.add_parameter("Refine fraction",
                      refine_fraction,
                      "The cells of the largest errors with this part of the "
                      "whole are divided.",
                      NumberPattern(
                        {Ranges::above_0, 1., "greater than 0, at most 1"}));
    prm.add_parameter("Coarsen fraction",
                      coarsen_fraction,
                      "The cells of the smallest errors with this part of the "
                      "whole are joined.",
                      fraction);
    prm.add_parameter(
      "Tolerance",
      tolerance,
      "Estimated error of the stress, relative to the stress (both in the "
      "energy norm), at which adaptive refinement ends; 0: none.",
      fraction);
    prm.add_parameter(
      "Instants",
      instants,
      "Instants within the period whose errors count, the largest of each "
      "cell; nothing: that of the largest load and that of the most opposite "
      "one, if there is an opposite one. In units of time. Allowed: numbers "
      "from 0 to the period, separated by commas",
      dealii::Patterns::List(NumberPattern(Ranges::not_negative)));
    prm.add_parameter(
      "Readapt every",
      readapt_every,
      "Number of periods after which the mesh is adapted anew to the stress "
      "of the last of them; 0: never.",
      count);
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
                   "must be, with Refine fraction, at most 1");
    // Each level halves the cells: 2^-40 is at the rounding of coordinates.
    checker.demand(!tip || cycles <= 40,
                   "Cycles",
                   "must be at most 40 with Strategy = tip: each divides the "
                   "size of the cells at the tip by 2");
    checker.demand(!tip || ends,
                   "Strategy",
                   "needs Cycles or Target unknowns to be greater than 0: "
                   "otherwise it would not end");
    checker.demand(!adaptive || ends || tolerance > 0.,
                   "Strategy",
                   "needs Cycles, Target unknowns or Tolerance to be greater "
                   "than 0: otherwise it would not end");
    checker.demand(readapt_every == 0 || adaptive,
                   "Readapt every",
                   "is for Strategy = adaptive; otherwise it must be 0");
  }
} // namespace Crevasse
