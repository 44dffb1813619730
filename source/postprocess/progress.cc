// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/postprocess/lip_state.h>
#include <crevasse/postprocess/progress.h>

#include <deal.II/base/mpi.h>

#include <cmath>
#include <cstdio>
#include <limits>
#include <string>

namespace Crevasse
{
  using namespace dealii;

  namespace
  {
    template <typename... Arguments>
    std::string
    format(const char *pattern, const Arguments... arguments)
    {
      char text[160];
      std::snprintf(text, sizeof(text), pattern, arguments...);
      return text;
    }
  } // namespace



  template <int dim>
  Progress<dim>::Progress(Log                        &log,
                          const ContactBoundary<dim> &lip,
                          const double                period,
                          const unsigned int          maximum_periods,
                          const MPI_Comm              communicator)
    : log(log)
    , lip(lip)
    , length(period)
    , maximum_periods(maximum_periods)
    , communicator(communicator)
    , any_terminal(
        Utilities::MPI::max(log.on_terminal() ? 1 : 0, communicator) == 1)
  {
    log.line("");
    log.line("  period        t  change of stress  estimated error  VIs");
  }



  template <int dim>
  void
  Progress<dim>::observe(const Sample &sample)
  {
    if (!any_terminal)
      return;
    // A few lines a second are enough. The clock of the rank at the terminal
    // decides for all, because the state of the lip is spread over them.
    const double seconds = timer.wall_time();
    const bool   due     = log.on_terminal() && seconds > last_shown + 0.2;
    if (Utilities::MPI::max(due ? 1 : 0, communicator) == 0)
      return;
    last_shown = seconds;

    const LipState now = lip_state(lip, sample.state);
    // In periods; no time is left to be told before anything is done.
    const double done = sample.period - 1. + sample.instant / length;
    const double left =
      done > 0. ? seconds * (double(maximum_periods) / done - 1.) : 0.;
    log.progress(format(
      "  period %u of at most %u, step %u at t = %g, %u of the lip's nodes "
      "closed, at most %.0f s left",
      sample.period,
      maximum_periods,
      sample.step + 1,
      sample.time,
      now.closed_nodes,
      left));
  }



  template <int dim>
  void
  Progress<dim>::end_of_period(const PeriodReport &report)
  {
    // The first period has none before it from which its stress could change,
    // and adaptive steps may not be those of the period before.
    const auto shown = [](const double value, const char *pattern) {
      return std::isfinite(value) ? format(pattern, value) : "-";
    };
    const double unknown = std::numeric_limits<double>::quiet_NaN();
    log.line(
      format("  %6u %8g  %16s  %15s %4zu",
             report.period,
             report.end_time,
             shown(report.period == 1 ? unknown : report.stress_change, "%.6e")
               .c_str(),
             shown(report.stress_error_estimate, "%.1e").c_str(),
             report.vi_solves));
  }



  template class Progress<2>;
  template class Progress<3>;
} // namespace Crevasse
