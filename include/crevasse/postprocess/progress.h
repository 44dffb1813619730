// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_postprocess_progress_h
#define crevasse_postprocess_progress_h

#include <crevasse/base/log.h>
#include <crevasse/discretisation/contact_boundary.h>
#include <crevasse/time/observer.h>

#include <deal.II/base/timer.h>

namespace Crevasse
{
  /** A line that moves on a terminal, and one line a period everywhere. */
  template <int dim>
  class Progress : public Observer
  {
  public:
    Progress(Log                        &log,
             const ContactBoundary<dim> &lip,
             const double                period,
             const unsigned int          maximum_periods,
             const MPI_Comm              communicator);

    void
    observe(const Sample &sample) override;

    void
    end_of_period(const PeriodReport &report) override;

  private:
    Log                        &log;
    const ContactBoundary<dim> &lip;
    const double                length; ///< of a period
    const unsigned int          maximum_periods;
    const MPI_Comm              communicator;
    const bool                  any_terminal;
    const dealii::Timer         timer;
    double                      last_shown = 0.;
  };
} // namespace Crevasse

#endif
