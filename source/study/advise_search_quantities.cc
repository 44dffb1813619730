// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/study/advise_report.h>
#include <crevasse/study/advise_search.h>

#include <algorithm>

// Which quantities have an error that can be reached, and what asks for the
// finest meshes.

namespace Crevasse
{
  std::optional<bool>
  AdviseSearch::diverges(const Progress   &family,
                         const std::size_t quantity,
                         const double      error)
  {
    const std::size_t n      = family.points.size();
    const auto        change = [&](const std::size_t k) {
      return runs.differences(*all[family.points[k - 1]].run,
                              *all[family.points[k]].run)[quantity];
    };
    if (n < 2)
      return {};
    // At a tip each halving changes the stress by 1 - 1/sqrt(2) of itself.
    constexpr double large = 0.1, falls = 0.75;
    if (change(n - 1) < std::max(large, error))
      return false;
    if (n < 3)
      return {};
    return change(n - 1) > falls * change(n - 2);
  }



  std::optional<std::size_t>
  AdviseSearch::to_be_looked_at(const double error)
  {
    // The first such family is the cheapest one. Where it finds something
    // suspicious, the others are asked too.
    bool suspicious = true;
    for (std::size_t f = 0; f < families.size() && suspicious; ++f)
      if (families[f].halves_cells)
        {
          const std::size_t n = progress[f].points.size();
          suspicious          = n < 2;
          for (std::size_t q = 0; q < runs.quantities().size(); ++q)
            if (n >= 2 && runs.counts(q))
              suspicious =
                suspicious || diverges(progress[f], q, error).value_or(true);
          if (suspicious && n < 3 && may_go_on(f))
            return f;
        }
    return {};
  }



  void
  AdviseSearch::leave_out_what_diverges(const double error)
  {
    for (std::size_t q = 0; q < runs.quantities().size(); ++q)
      {
        std::size_t n_diverge = 0, n_converge = 0;
        for (std::size_t f = 0; f < families.size(); ++f)
          if (families[f].halves_cells && runs.counts(q))
            {
              const auto does = diverges(progress[f], q, error);
              // What cannot be told yet counts for nothing, unless it will be.
              if (does)
                ++(*does ? n_diverge : n_converge);
              else if (progress[f].points.size() < 3 && !progress[f].ended)
                ++n_converge;
            }
        if (n_diverge == 0 || n_converge > 0)
          continue;
        runs.leave_out(q);
        all_notes.push_back(
          runs.quantities()[q].name +
          " is left out: it does not converge as the cells are halved. The "
          "stress at a crack tip is infinite, at a free corner zero, and on "
          "the line between two materials it has two values: move the probe "
          "to where the stress is one number");
        log.line("  " + runs.quantities()[q].name +
                 " does not converge as the cells are halved: left out");
      }
  }



  void
  AdviseSearch::name_the_hardest()
  {
    constexpr double many_unknowns = 1e4, clearly = 4.;
    if (hardest_is_named || part == Part::time || all.empty() ||
        all[finest].run->cost("unknowns") < many_unknowns)
      return;
    const auto &own = progress[all[finest].family].points;
    if (own.size() < 2)
      return;
    const std::vector<double> &changes =
      runs.differences(*all[own[own.size() - 2]].run, *all[own.back()].run);
    std::size_t hardest = 0;
    double      largest = 0., next = 0.;
    for (std::size_t q = 0; q < changes.size(); ++q)
      if (runs.counts(q))
        {
          next = std::max(next, std::min(changes[q], largest));
          if (changes[q] > largest)
            {
              largest = changes[q];
              hardest = q;
            }
        }
    if (runs.n_that_count() < 2 || largest < clearly * next)
      return;
    hardest_is_named = true;
    log.line("  it is " + runs.quantities()[hardest].name +
             " that asks for such meshes: it still changes by " +
             AdviseReport::short_number(largest) + ", all else by at most " +
             AdviseReport::short_number(next) +
             ". If it does not matter, name what does with --quantities.");
  }
} // namespace Crevasse
