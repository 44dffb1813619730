// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_base_stopwatch_h
#define crevasse_base_stopwatch_h

#include <deal.II/base/timer.h>

namespace Crevasse
{
  /** Adds the wall time of its life to a sum. */
  class Stopwatch
  {
  public:
    explicit Stopwatch(double &seconds)
      : seconds(seconds)
    {}

    ~Stopwatch()
    {
      seconds += timer.wall_time();
    }

  private:
    double       &seconds;
    dealii::Timer timer;
  };
} // namespace Crevasse

#endif
