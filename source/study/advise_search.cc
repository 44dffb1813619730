// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/text.h>
#include <crevasse/study/advise_search.h>

#include <algorithm>
#include <cmath>

namespace Crevasse
{
  namespace
  {
    constexpr double unknown_error = std::numeric_limits<double>::infinity();

    // Of the error that is looked for, what the reference may have.
    constexpr double part_of_finest = 0.3;

    // What one run of a search may take.
    constexpr double most_unknowns = 3e5;
    constexpr double most_seconds  = 300.;



    /** The first sentence of a message, for a note. */
    std::string
    first_sentence(const std::string &message)
    {
      const std::string line = Text::squeeze(message);
      const std::size_t end  = line.find(". ");
      return end == std::string::npos ? line : line.substr(0, end + 1);
    }
  } // namespace



  AdviseSearch::AdviseSearch(const Part                       part,
                             const std::vector<AdviseFamily> &families,
                             const Run                       &run,
                             AdviseRuns                      &runs,
                             Log                             &log)
    : part(part)
    , families(families)
    , run(run)
    , runs(runs)
    , log(log)
    , progress(families.size())
  {
  }



  const std::vector<AdvisePoint> &
  AdviseSearch::points() const
  {
    return all;
  }



  std::size_t
  AdviseSearch::reference() const
  {
    return finest;
  }



  const std::vector<std::string> &
  AdviseSearch::notes() const
  {
    return all_notes;
  }



  double
  AdviseSearch::cost(const AdvisePoint &point) const
  {
    return part == Part::time ? point.run->work() : point.run->seconds();
  }



  bool
  AdviseSearch::extend_to(const double error)
  {
    while (true)
      {
        const auto best = cheapest(error);
        const bool reference_is_good =
          !all.empty() && all[finest].error <= part_of_finest * error;
        auto next = to_be_looked_at(error);
        // On a coarse mesh steps that leave a little more cost next to nothing
        // to know, and may suit a mesh that leaves a little less.
        if (!next)
          next =
            best && part == Part::time
              ? cheapest_next(cost(all[*best]), unknown_error)
              : cheapest_next(best ? cost(all[*best]) : unknown_error, error);
        if (best && !reference_is_good && !next)
          {
            const std::size_t family = all[finest].family;
            next = may_go_on(family) ? std::make_optional(family)
                                     : cheapest_next(unknown_error, error);
          }
        if (!next)
          return best.has_value();
        run_next(*next);
        if (families[*next].halves_cells)
          leave_out_what_diverges(error);
        estimate();
        name_the_hardest();
      }
  }



  std::optional<std::size_t>
  AdviseSearch::cheapest(const double error) const
  {
    std::optional<std::size_t> best;
    for (std::size_t p = 0; p < all.size(); ++p)
      if (p != finest && all[p].error <= error &&
          (!best || cost(all[p]) < cost(all[*best])))
        best = p;
    return best;
  }



  double
  AdviseSearch::growth(const std::size_t family) const
  {
    const std::vector<std::size_t> &own   = progress[family].points;
    const double                    least = families[family].growth;
    if (part == Part::time || own.size() < 2)
      return least;
    return std::max(least,
                    all[own.back()].run->cost("unknowns") /
                      all[own[own.size() - 2]].run->cost("unknowns"));
  }



  double
  AdviseSearch::predicted_cost(const std::size_t family,
                               const double      n_levels) const
  {
    const std::vector<std::size_t> &own = progress[family].points;
    if (own.empty())
      return 0.;
    // Part of each run is the same for all.
    double least = unknown_error;
    for (const AdvisePoint &point : all)
      least = std::min(least, cost(point));
    const double constant = part == Part::time ? 0. : 0.8 * least;
    return constant + (cost(all[own.back()]) - constant) *
                        std::pow(growth(family), n_levels);
  }



  double
  AdviseSearch::levels_to(const std::size_t family, const double error) const
  {
    const std::vector<std::size_t> &own = progress[family].points;
    if (own.empty() || all[own.back()].error == unknown_error ||
        error == unknown_error)
      return 1.;
    // As it did last time; before that as the best of all methods do.
    constexpr double hope = 0.15, worst = 0.95;
    const double     last = all[own.back()].error;
    const double     ratio =
      own.size() < 2
            ? hope
            : std::clamp(last / all[own[own.size() - 2]].error, 0.02, worst);
    return std::max(1., std::ceil(std::log(last / error) / -std::log(ratio)));
  }



  bool
  AdviseSearch::may_go_on(const std::size_t f)
  {
    if (progress[f].ended)
      return false;
    if (progress[f].next == families[f].candidates.size())
      {
        end(f, "its finest candidate was run");
        return false;
      }
    const std::vector<std::size_t> &own = progress[f].points;
    const double                    seconds =
      own.empty() ? 0. : growth(f) * all[own.back()].run->seconds();
    const double unknowns =
      part == Part::time || own.empty()
        ? 0.
        : growth(f) * all[own.back()].run->cost("unknowns");
    if (unknowns > most_unknowns)
      end(f,
          "the next mesh would have about " +
            std::to_string(std::lround(unknowns)) + " unknowns");
    else if (seconds > most_seconds)
      end(f,
          "the next run would take about " +
            std::to_string(std::lround(seconds)) + " s");
    return !progress[f].ended;
  }



  std::optional<std::size_t>
  AdviseSearch::cheapest_next(const double less_than, const double error)
  {
    std::optional<std::size_t> best;
    double                     least = less_than;
    for (std::size_t f = 0; f < families.size(); ++f)
      {
        const double cost = predicted_cost(f, levels_to(f, error));
        if (cost < least && may_go_on(f))
          {
            best  = f;
            least = cost;
          }
      }
    return best;
  }



  void
  AdviseSearch::run_next(const std::size_t family)
  {
    const AdviseCandidate &candidate =
      families[family].candidates[progress[family].next++];
    const AdviseRun &of = run(candidate);
    if (of.usable())
      add(family, {candidate, &of, family});
    else if (of.result.status != "refused" ||
             ++progress[family].n_refused > families[family].refusals_that_pass)
      end(family,
          candidate.text + " " + of.result.status + ": " +
            first_sentence(of.result.message));
  }



  void
  AdviseSearch::add(const std::size_t family, const AdvisePoint &point)
  {
    std::vector<std::size_t> &own = progress[family].points;
    // An adaptive mesh may have had all that it is going to get.
    if (part == Part::space && !own.empty() &&
        all[own.back()].run->cost("unknowns") == point.run->cost("unknowns"))
      {
        end(family, "its mesh is not refined further");
        return;
      }
    own.push_back(all.size());
    all.push_back(point);
  }



  void
  AdviseSearch::end(const std::size_t family, const std::string &reason)
  {
    progress[family].ended = true;
    all_notes.push_back(families[family].text + ": " + reason);
  }



  double
  AdviseSearch::error_of_last(const Progress &family)
  {
    const std::size_t n = family.points.size();
    if (n < 2)
      return unknown_error;
    const auto change = [&](const std::size_t k) {
      return runs.difference(*all[family.points[k - 1]].run,
                             *all[family.points[k]].run);
    };
    const double last = change(n - 1);
    if (n < 3 || last == 0.)
      return last;
    // Errors that fall by a ratio each time; one that seems to fall very fast
    // may do so by chance.
    const double ratio = std::clamp(last / change(n - 2), 0.1, 0.8);
    return last * ratio / (1. - ratio);
  }



  void
  AdviseSearch::estimate()
  {
    double least = unknown_error;
    for (const Progress &family : progress)
      {
        const double error = error_of_last(family);
        if (error < least)
          {
            least  = error;
            finest = family.points.back();
          }
      }
    if (least == unknown_error)
      return;
    for (std::size_t p = 0; p < all.size(); ++p)
      all[p].error =
        least +
        (p == finest ? 0. : runs.difference(*all[p].run, *all[finest].run));
  }
} // namespace Crevasse
