// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_postprocess_period_table_h
#define crevasse_postprocess_period_table_h

#include <crevasse/base/csv_table.h>
#include <crevasse/base/log.h>
#include <crevasse/base/text.h>
#include <crevasse/lip/contact_boundary.h>
#include <crevasse/parameters/scene.h>
#include <crevasse/time/observer.h>

namespace Crevasse
{
  /** periods.csv: convergence to the periodic state, and its cost. The rows
   * are also logged, with a progress line on terminals. */
  class PeriodTable : public Observer
  {
  public:
    PeriodTable(CsvTable       &&table,
                const Scene     &scene,
                const LipTotals &lip,
                Log             &log)
      : table(std::move(table))
      , scene(scene)
      , lip(lip)
      , log(log)
    {
      log.line("\n  period        t  change of stress  estimated error  VIs");
    }

    void
    observe(const Sample &sample) override
    {
      if (!log.on_terminal())
        return;
      const double done = // periods done
        sample.period - 1. + sample.instant / scene.loads.period;
      if (done_before < 0.)
        done_before = done;
      // Limits progress to a few lines a second.
      const double seconds = timer.wall_time();
      if (seconds <= last_shown + 0.2)
        return;
      last_shown        = seconds;
      const double most = scene.periodic_state.maximum_periods;
      const double now  = done - done_before;
      log.progress(Text::format(
        "  period %u of at most %.0f, step %u at t = %g, %u of the lip's "
        "nodes closed, at most %.0f s left",
        sample.period,
        most,
        sample.step + 1,
        sample.time,
        lip.closed_nodes,
        now > 0. ? seconds * (most - done) / now : 0.));
    }

    void
    end_of_period(const PeriodReport &report) override
    {
      table.add_row({double(report.period),
                     report.end_time,
                     report.stress_change,
                     report.stress_error_estimate,
                     double(report.vi_solves),
                     report.seconds});
      // The first period has no period before to compare its stress with, and
      // adaptive steps may differ from those of the period before.
      const auto shown =
        [](const char *pattern, const double value, const bool is_known) {
          return is_known && std::isfinite(value) ? Text::format(pattern, value)
                                                  : "-";
        };
      log.line(Text::format(
        "  %6u %8g  %16s  %15s %4zu%s",
        report.period,
        report.end_time,
        shown("%.6e", report.stress_change, report.period > 1).c_str(),
        shown("%.1e", report.judged_error, report.judged_error <= 1.).c_str(),
        report.vi_solves,
        report.mission > 0
          ? ("  mission " + std::to_string(report.mission)).c_str()
          : ""));
    }

  private:
    CsvTable            table;
    const Scene        &scene;
    const LipTotals    &lip;
    Log                &log;
    const dealii::Timer timer;
    double              last_shown  = 0.;
    double              done_before = -1.; ///< before this mesh or resume
  };
} // namespace Crevasse

#endif
