// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/stop_request.h>

#include <algorithm>
#include <atomic>
#include <cstring>
#include <filesystem>

namespace Crevasse
{
  namespace
  {
    // Number of a signal, and a flag, set by handlers in any thread.
    std::atomic<int> asked_to_stop(0), asked_to_write(0);
    static_assert(std::atomic<int>::is_always_lock_free,
                  "else handlers must not use them");



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
        handle(signal, [](const int signal) { asked_to_stop = signal; });
      }
    handle(SIGUSR1, [](int) { asked_to_write = 1; });
  }



  StopRequests::~StopRequests()
  {
    // A second signal to stop must not kill the program.
    if (asked_to_stop == 0)
      for (const auto &[signal, action] : actions_before)
        sigaction(signal, &action, nullptr);
    // No checkpoint is left to write; by default SIGUSR1 kills the program.
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



  int
  StopRequests::of_file()
  {
    std::error_code not_there;
    if (file.empty() || !std::filesystem::is_regular_file(file, not_there))
      return none;
    std::filesystem::remove(file, not_there);
    why = "the file " + file;
    return stop * first_request;
  }



  int
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
    return stop * first_request;
  }



  StopRequests::Request
  StopRequests::poll(const double seconds_to_write)
  {
    int request = none;
    if (asked_to_stop != 0)
      request = stop * first_request + asked_to_stop;
    else if (asked_to_write.exchange(0) != 0)
      request = checkpoint * first_request + SIGUSR1;
    if (first_rank)
      request = std::max({request, of_file(), of_time(seconds_to_write)});
    request = dealii::Utilities::MPI::max(request, communicator);
    if (const int signal = request % first_request; signal != 0)
      why = std::string("SIG") + sigabbrev_np(signal);
    return Request(request / first_request);
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



} // namespace Crevasse
