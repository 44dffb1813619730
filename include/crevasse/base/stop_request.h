// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_base_stop_request_h
#define crevasse_base_stop_request_h

#include <deal.II/base/mpi.h>
#include <deal.II/base/timer.h>

#include <csignal>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace Crevasse
{
  /** Signals that ask a run to end. */
  constexpr int signals_to_stop[] = {SIGTERM, SIGINT, SIGHUP};



  /** A run ends because it was asked to: no failure. The program ends with exit
   * status 5; the message says what was kept. */
  struct StoppedOnRequest : std::runtime_error
  {
    using std::runtime_error::runtime_error;
  };

  /**
   * Whether somebody wants the run to end, or to be kept: signals, a file
   * "stop" in the output directory, or the end of the time that was granted.
   *
   * SIGTERM, SIGINT and SIGHUP end the run at the next opportunity, however
   * often they come; SIGUSR1 has a checkpoint written. Handlers only set a
   * flag. One small reduction makes all ranks know at the same moment.
   */
  class StopRequests
  {
  public:
    enum Request
    {
      none       = 0,
      checkpoint = 1, ///< and go on
      stop       = 2
    };

    /** Catches the signals from now on, but for those to stop that the program
     * was begun to ignore; there is one such object.
     *
     * @param wall_time in seconds from now on; 0: any. */
    StopRequests(const MPI_Comm communicator, const double wall_time);

    /** Signals do again what they did before, but for SIGUSR1, which is
     * ignored. */
    ~StopRequests();

    StopRequests(const StopRequests &) = delete;
    StopRequests &
    operator=(const StopRequests &) = delete;

    /** From now on looks for a file "stop" there; one that is there already
     * was meant for another run and is removed. Collective. */
    void
    look_in(const std::string &directory);

    /** Looks, between two steps: the longest time between two calls is what
     * the next step may take. A file "stop" is removed. Collective.
     *
     * @param seconds_to_write what a checkpoint takes. */
    Request
    poll(const double seconds_to_write);

    /** The time until the next call says nothing about steps. */
    void
    skip_interval()
    {
      last_poll = -1.;
    }

    /** Looks where nothing can be kept. Collective.
     * @throw StoppedOnRequest if the run is to end. */
    void
    stop_if_asked();

    /** Who asked, for the log: "SIGTERM", "the file .../stop", ... Known on
     * the first rank, if not by a signal to another one alone. */
    const std::string &
    reason() const
    {
      return why;
    }

  private:
    // A request and the signal that brought it, if it was one, in one number.
    static constexpr int first_request = 64;

    int
    of_file();

    int
    of_time(const double seconds_to_write);

    const MPI_Comm communicator;
    const bool     first_rank;
    const double   wall_time;
    std::string    file; ///< to look for; empty: none
    std::string    why;

    std::vector<std::pair<int, struct sigaction>> actions_before;

    const dealii::Timer since_begin;
    double              last_poll = -1.; ///< negative: does not count
    double              longest   = 0.;  ///< between two polls
  };
} // namespace Crevasse

#endif
