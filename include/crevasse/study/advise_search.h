// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_study_advise_search_h
#define crevasse_study_advise_search_h

#include <crevasse/base/log.h>
#include <crevasse/study/advise_candidates.h>
#include <crevasse/study/advise_runs.h>

#include <cstddef>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace Crevasse
{
  /** A candidate that was run, all else being the same for all of them. */
  struct AdvisePoint
  {
    AdviseCandidate  candidate;
    const AdviseRun *run    = nullptr;
    std::size_t      family = 0;
    /** Estimated, of this part of the settings alone. */
    double error = std::numeric_limits<double>::infinity();
  };

  /**
   * Runs candidates of some families, the next one of that which promises the
   * error asked for at the least cost, until one has it and no family promises
   * it cheaper.
   *
   * Errors are differences from the finest run of the family that converges
   * best, plus what that one is estimated to be off: its difference from the
   * run before it, by the ratio of its last two differences.
   */
  class AdviseSearch
  {
  public:
    /** The run of a candidate. */
    using Run = std::function<const AdviseRun &(const AdviseCandidate &)>;

    /** Whether candidates differ in their meshes. */
    enum class Part
    {
      time,
      space
    };

    AdviseSearch(const Part                       part,
                 const std::vector<AdviseFamily> &families,
                 const Run                       &run,
                 AdviseRuns                      &runs,
                 Log                             &log);

    /** Goes on until a point has @p error and the reference a fraction of it.
     * Whether they have it. */
    bool
    extend_to(const double error);

    /** All with results, in the order of their runs. */
    const std::vector<AdvisePoint> &
    points() const;

    /** The point that the others are measured against; the index. */
    std::size_t
    reference() const;

    /** The cheapest but the reference with at most this error. */
    std::optional<std::size_t>
    cheapest(const double error) const;

    /** Why families ended, and what was left out. */
    const std::vector<std::string> &
    notes() const;

    /** What a run costs beside others of this search: seconds, or work. */
    double
    cost(const AdvisePoint &point) const;

  private:
    struct Progress
    {
      std::size_t              next      = 0; ///< candidate
      unsigned int             n_refused = 0;
      std::vector<std::size_t> points;
      bool                     ended = false;
    };

    /** The errors of all points. */
    void
    estimate();

    /** How far the last point of a family is off. */
    double
    error_of_last(const Progress &family);

    /** What the work is multiplied with from one level to the next, where
     * meshes have shown it. */
    double
    growth(const std::size_t family) const;

    /** What a candidate is going to cost that many levels further. */
    double
    predicted_cost(const std::size_t family, const double n_levels) const;

    /** How many levels a family still needs; at least one, and no more if the
     * error does not matter (infinite). */
    double
    levels_to(const std::size_t family, const double error) const;

    /** Whether its next candidate may be run: sizes and times are limited. */
    bool
    may_go_on(const std::size_t family);

    /** The family that promises the error at the least cost, if this is less
     * than the given one. */
    std::optional<std::size_t>
    cheapest_next(const double less_than, const double error);

    /** A family whose next run may tell that a quantity does not converge. */
    std::optional<std::size_t>
    to_be_looked_at(const double error);

    void
    run_next(const std::size_t family);

    /** Takes a point in, if it is another one than that before it. */
    void
    add(const std::size_t family, const AdvisePoint &point);

    void
    end(const std::size_t family, const std::string &reason);

    /** Quantities that keep changing as all cells are halved. */
    void
    leave_out_what_diverges(const double error);

    /** Whether a quantity does so in one family; nothing if it cannot be told
     * yet. */
    std::optional<bool>
    diverges(const Progress   &family,
             const std::size_t quantity,
             const double      error);

    /** Tells once if one quantity alone makes the search expensive. */
    void
    name_the_hardest();

    const Part                      part;
    const std::vector<AdviseFamily> families;
    const Run                       run;
    AdviseRuns                     &runs;
    Log                            &log;

    std::vector<Progress>    progress;
    std::vector<AdvisePoint> all;
    std::size_t              finest = 0;
    std::vector<std::string> all_notes;
    bool                     hardest_is_named = false;
  };
} // namespace Crevasse

#endif
