// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_study_sweep_table_h
#define crevasse_study_sweep_table_h

#include <crevasse/study/quantity.h>
#include <crevasse/study/sweep_plan.h>
#include <crevasse/study/sweep_result.h>

#include <optional>
#include <string>
#include <vector>

namespace Crevasse
{
  /** The results of a sweep as sweep.csv, sweep.md and sweep.json. All three
   * are written as a whole after each point. */
  class SweepTable
  {
  public:
    /** @param title of the table, and the
     * @p reference in words. The plan must outlive this. */
    SweepTable(const SweepPlan             &plan,
               const std::vector<Quantity> &quantities,
               const std::string           &title,
               const std::string           &reference);

    /** The result of the reference run, for its costs. */
    void
    set_reference(const SweepResult &result);

    /** The points come in the order of the plan. */
    void
    add(const SweepResult &result);

    /** @throw FileError */
    void
    write(const std::string &directory) const;

    /** One line about a point: values, errors, cost. */
    std::string
    line(const std::size_t point) const;

    /** "Scheme = heun, Steps per period = 20". */
    std::string
    values(const std::size_t point) const;

    /** How many points have results. */
    std::size_t
    n_with_results() const;

  private:
    std::string
    csv() const;
    std::string
    markdown() const;
    std::string
    markdown_header() const;
    std::string
    markdown_notes() const;
    Summary
    json() const;

    /** The name of a parameter without its section, where that is enough. */
    std::string
    short_name(const std::size_t parameter) const;

    /** The point before this one along the main axis of the plan. */
    std::optional<std::size_t>
    predecessor(const std::size_t point) const;

    /** The p of error ~ number^-p between the predecessor and this point. */
    std::optional<double>
    order(const std::size_t point, const Quantity &quantity) const;

    std::optional<double>
    error(const std::size_t point, const Quantity &quantity) const;

    const SweepPlan            &plan;
    const std::vector<Quantity> quantities;
    const std::string           title, reference;
    const std::vector<double>   numbers; ///< of the main axis
    std::optional<SweepResult>  reference_result;
    std::vector<SweepResult>    results;
  };
} // namespace Crevasse

#endif
