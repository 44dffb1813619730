// ---------------------------------------------------------------------
//
// Copyright (C) 2026 by the Crevasse authors
//
// This file is part of Crevasse. It is free software; you can use it,
// redistribute it and/or modify it under the terms of the GNU Lesser
// General Public License as published by the Free Software Foundation;
// either version 2.1 of the License, or (at your option) any later version.
//
// ---------------------------------------------------------------------

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
