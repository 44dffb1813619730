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
  /** Signals that ask a run to stop. */
  constexpr int signals_to_stop[] = {SIGTERM, SIGINT, SIGHUP};



  /** Exception that ends a run on request; no failure. The program ends with
   * exit status 5; the message says what was saved. */
  struct StoppedOnRequest : std::runtime_error
  {
    using std::runtime_error::runtime_error;
  };

  /**
   * Requests to stop the run or to write a checkpoint: signals, a file "stop"
   * in the output directory, or the end of the allowed wall time.
   *
   * SIGTERM, SIGINT and SIGHUP stop the run at the next opportunity, however
   * often they come; SIGUSR1 requests a checkpoint. Handlers only set a flag.
   * One small reduction makes all ranks know at the same moment.
   */
  class StopRequests
  {
  public:
    enum Request
    {
      none       = 0,
      checkpoint = 1, ///< request for a checkpoint only
      stop       = 2
    };

    /** Starts to catch signals, except stop signals that the program ignored
     * when it started. Only one such object may exist.
     *
     * @param wall_time Allowed seconds from now on; 0: unlimited. */
    StopRequests(const MPI_Comm communicator, const double wall_time);

    /** Restores the previous actions of signals; SIGUSR1 is then ignored. */
    ~StopRequests();

    StopRequests(const StopRequests &) = delete;

    /** Starts to look for a file "stop" in this directory. Removes a file
     * "stop" that was meant for an earlier run. Collective. */
    void
    look_in(const std::string &directory);

    /** Checks for requests between two steps. The longest time between two
     * calls estimates the next step. Removes a file "stop". Collective.
     *
     * @param seconds_to_write Estimated time to write a checkpoint. */
    Request
    poll(const double seconds_to_write);

    /** Excludes the time until the next poll() from the estimate of a step. */
    void
    skip_interval()
    {
      last_poll = -1.;
    }

    /** Checks for requests where no checkpoint can be written. Collective.
     * @throw StoppedOnRequest if the run is to stop. */
    void
    stop_if_asked();

    /** Source of the request for the log: "SIGTERM", "the file .../stop", ...
     * Known on the first rank, except a signal to another rank alone. */
    const std::string &
    reason() const
    {
      return why;
    }

  private:
    // Factor to encode a request and its signal, if any, in one number.
    static constexpr int first_request = 64;

    int
    of_file();

    int
    of_time(const double seconds_to_write);

    const MPI_Comm communicator;
    const bool     first_rank;
    const double   wall_time;
    std::string    file; ///< file "stop" to look for, or empty
    std::string    why;

    std::vector<std::pair<int, struct sigaction>> actions_before;

    const dealii::Timer since_begin;
    double last_poll = -1.; ///< time of the last poll; negative: excluded
    double longest   = 0.;  ///< longest time between two polls
  };
} // namespace Crevasse

#endif
