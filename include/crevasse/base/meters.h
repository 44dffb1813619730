// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_base_meters_h
#define crevasse_base_meters_h

#include <crevasse/base/log.h>
#include <crevasse/base/summary.h>

#include <chrono>
#include <exception>
#include <map>
#include <string>
#include <utility>

namespace Crevasse
{
  /** Wall time and number of calls of one activity of a run. */
  struct Meter
  {
    double seconds = 0.;
    double own     = 0.; ///< seconds without those of nested meters
    double calls   = 0.;

    template <typename Archive>
    void
    serialize(Archive &archive, const unsigned int)
    {
      archive &seconds &own &calls;
    }
  };

  /** Meters of a run by the name of the activity. */
  using Meters = std::map<std::string, Meter, std::less<>>;

  /** Meters filled by the stopwatches of this process. */
  inline Meters meters;

  /** Adds the wall time of its life to a meter. A nested stopwatch must end
   * first; its time is not added to the own time of this meter. */
  class Stopwatch
  {
  public:
    /** @param calls is not added if an exception ends it. */
    explicit Stopwatch(const char *name, const double calls = 1.)
      : name(name)
      , calls(calls)
    {
    }

    ~Stopwatch()
    {
      Meter &meter = add_time();
      innermost    = outer;
      if (std::uncaught_exceptions() == 0)
        meter.calls += calls;
    }

    Stopwatch(const Stopwatch &) = delete;

    /** Updates the meters of all running stopwatches. */
    static void
    update()
    {
      for (Stopwatch *watch = innermost; watch != nullptr; watch = watch->outer)
        watch->add_time();
    }

  private:
    using Clock = std::chrono::steady_clock;

    Meter &
    add_time()
    {
      // Only the first call builds a std::string: this runs in the time loop.
      auto meter = meters.find(name);
      if (meter == meters.end())
        meter = meters.emplace(name, Meter()).first;
      const auto   now  = Clock::now();
      const double time = std::chrono::duration<double>(now - begin).count();
      meter->second.seconds += time;
      meter->second.own += time - of_others;
      if (outer != nullptr)
        outer->of_others += time;
      begin     = now;
      of_others = 0.;
      return meter->second;
    }

    inline static Stopwatch *innermost = nullptr;

    const char *const name; ///< name of the meter, a literal
    const double      calls;
    Stopwatch *const  outer     = std::exchange(innermost, this);
    double            of_others = 0.;
    Clock::time_point begin     = Clock::now();
  };

  /** Name of the meter that runs from the beginning to the end of a run. */
  constexpr const char *all_else = "all else";

  /** Adds the times of all meters of this process to the summary. If the log is
   * verbose, prints them as a table.
   *
   * @return the seconds of the run. */
  double
  report_meters(Log &log, Summary &summary);
} // namespace Crevasse

#endif
