// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/stop_request.h>

#include <algorithm>
#include <atomic>
#include <filesystem>
#include <iterator>

namespace Crevasse
{
  namespace
  {
    const std::string signals[] = {"",
                                   "SIGTERM",
                                   "SIGINT",
                                   "SIGHUP",
                                   "SIGUSR1"};



    std::string
    name_of(const int signal)
    {
      return signal == SIGINT   ? "SIGINT"
             : signal == SIGHUP ? "SIGHUP"
                                : "SIGTERM";
    }



    // Set by handlers, in whichever thread they run.
    std::atomic<int> asked_to_stop(0), asked_to_write(0);
    static_assert(std::atomic<int>::is_always_lock_free,
                  "else handlers must not use them");



    void
    note_stop(const int signal)
    {
      asked_to_stop = signal;
    }



    void
    note_write(int)
    {
      asked_to_write = 1;
    }



    void
    handle(const int signal, void (*handler)(int))
    {
      struct sigaction action = {};
      action.sa_handler       = handler;
      action.sa_flags         = SA_RESTART;
      sigaction(signal, &action, nullptr);
    }
  } // namespace



  StopRequests::StopRequests(const MPI_Comm communicator,
                             const double   wall_time)
    : communicator(communicator)
    , first_rank(dealii::Utilities::MPI::this_mpi_process(communicator) == 0)
    , wall_time(wall_time)
  {
    asked_to_stop = asked_to_write = 0;
    for (const int signal : signals_to_stop)
      {
        struct sigaction before = {};
        sigaction(signal, nullptr, &before);
        if (before.sa_handler == SIG_IGN)
          continue;
        actions_before.emplace_back(signal, before);
        handle(signal, note_stop);
      }
    handle(SIGUSR1, note_write);
  }



  StopRequests::~StopRequests()
  {
    for (const auto &[signal, action] : actions_before)
      sigaction(signal, &action, nullptr);
    // There is nothing left to write; the default would kill the program.
    handle(SIGUSR1, SIG_IGN);
  }



  void
  StopRequests::look_in(const std::string &directory)
  {
    file = directory + "/stop";
    std::error_code not_there;
    if (first_rank)
      std::filesystem::remove(file, not_there);
  }



  StopRequests::Request
  StopRequests::of_signals()
  {
    if (asked_to_stop != 0)
      {
        why = name_of(asked_to_stop);
        return stop;
      }
    if (asked_to_write.exchange(0) == 0)
      return none;
    why = "SIGUSR1";
    return checkpoint;
  }



  StopRequests::Request
  StopRequests::of_file()
  {
    std::error_code not_there;
    if (file.empty() || !std::filesystem::is_regular_file(file, not_there))
      return none;
    std::filesystem::remove(file, not_there);
    why = "the file " + file;
    return stop;
  }



  StopRequests::Request
  StopRequests::of_time(const double seconds_to_write)
  {
    constexpr double margin = 1.5;
    const double     now    = since_begin.wall_time();
    if (last_poll >= 0.)
      longest = std::max(longest, now - last_poll);
    last_poll = now;
    if (wall_time == 0. ||
        now + margin * (longest + seconds_to_write) < wall_time)
      return none;
    why = "--wall-time";
    return stop;
  }



  StopRequests::Request
  StopRequests::poll(const double seconds_to_write)
  {
    int request = of_signals();
    if (first_rank)
      request =
        std::max({request, int(of_file()), int(of_time(seconds_to_write))});
    // The same number says what and who.
    constexpr int n_signals = std::size(signals);
    const auto    who  = std::find(std::begin(signals), std::end(signals), why);
    const int     code = request * n_signals +
                     (request == none ? 0 : int(who - signals) % n_signals);
    const int all = dealii::Utilities::MPI::max(code, communicator);
    if (all != code)
      why = signals[all % n_signals];
    return Request(all / n_signals);
  }



  void
  StopRequests::skip_interval()
  {
    last_poll = -1.;
  }



  void
  StopRequests::stop_if_asked()
  {
    skip_interval();
    const bool stops = poll(0.) == stop;
    skip_interval();
    if (stops)
      throw StoppedOnRequest("stopped on request (" + why +
                             "), without a checkpoint.");
  }



  const std::string &
  StopRequests::reason() const
  {
    return why;
  }
} // namespace Crevasse
