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
  /** The wall time of something that a run does, and how often it is done. */
  struct Meter
  {
    double seconds = 0.;
    double own     = 0.; ///< seconds without what other meters measure
    double calls   = 0.;
    double bytes   = 0.; ///< that the calls have to read, where that counts

    template <typename Archive>
    void
    serialize(Archive &archive, const unsigned int)
    {
      archive &seconds &own &calls &bytes;
    }
  };

  /** By what is done. */
  using Meters = std::map<std::string, Meter, std::less<>>;

  /** What the stopwatches of this process have measured. */
  inline Meters meters;

  /** Adds the wall time of its life to a meter. Another one that begins
   * meanwhile must end before; its time is not the own one of this meter. */
  class Stopwatch
  {
  public:
    /** @param calls and @p bytes do not count if it ends by an exception. */
    explicit Stopwatch(const char  *name,
                       const double calls = 1.,
                       const double bytes = 0.)
      : name(name)
      , calls(calls)
      , bytes(bytes)
    {
    }

    ~Stopwatch()
    {
      Meter &meter = add_time();
      innermost    = outer;
      if (std::uncaught_exceptions() > 0)
        return;
      meter.calls += calls;
      meter.bytes += bytes;
    }

    Stopwatch(const Stopwatch &) = delete;

    /** Brings the meters of those that run up to date. */
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
      // No text is made in the time loop but for the first call.
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

    const char *const name; ///< a literal
    const double      calls, bytes;
    Stopwatch *const  outer     = std::exchange(innermost, this);
    double            of_others = 0.;
    Clock::time_point begin     = Clock::now();
  };

  /** Under this name a run has a stopwatch from its beginning to its end. */
  constexpr const char *all_else = "all else";

  /** Adds to the summary what took how much of the time on rank 0, and prints
   * that as a table if the log is verbose: with it, what the memory of the
   * machine allows the linear solves at best. Collective.
   *
   * @return the seconds of the run. */
  double
  report_meters(const MPI_Comm communicator, Log &log, Summary &summary);
} // namespace Crevasse

#endif
