// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/app/run_command.h>
#include <crevasse/app/script_command.h>
#include <crevasse/base/single_process.h>
#include <crevasse/base/stop_request.h>

#include <chrono>
#include <csignal>
#include <cstdlib>

namespace
{
  /** Signals of signals_to_stop that the program ignores from its start: nohup
   * ignores SIGHUP, and shells SIGINT for background processes. */
  std::vector<int>
  ignored_signals()
  {
    std::vector<int> ignored;
    for (const int signal : Crevasse::signals_to_stop)
      if (struct sigaction action = {};
          sigaction(signal, nullptr, &action) == 0 &&
          action.sa_handler == SIG_IGN)
        ignored.push_back(signal);
    return ignored;
  }
} // namespace



int
main(int argc, char **argv)
{
  using namespace Crevasse;

  std::vector<std::string> words(argv, argv + argc);
  // A process that a server has forked goes on with the words of its run.
  if (argc > 1 && words[1] == "serve")
    words = serve();
  while (is_script_command(words))
    if (const auto of_run = leave_server())
      words = *of_run;
    else
      return run_script_command(words);
  if (words.size() > 3 && words[1] == "evaluate")
    return evaluate(words);
  if (words.size() > 3 && words[1] == "growth")
    return print_growth(words);
  const std::vector<int> ignored = ignored_signals();
  // A request for a checkpoint before the run can write one must not end the
  // program.
  std::signal(SIGUSR1, SIG_IGN);
  const Command command = parse_command_line(words);
  if (command.exit)
    return command.status;
  if (const int status = convert_mesh(command); status != done)
    return status;
  if (!command.print_format.empty())
    return show_parameters(command);
  if (command.accuracy > 0.)
    return repeat_until_accurate(command);

  using namespace std::chrono;
  const auto  start = steady_clock::now();
  std::string with_bars;
  int         status = done;
  set_up_single_process();
  {
    // PETSc, if deal.II starts it, would take options for its own and report
    // unused ones: it gets only the name of the program.
    int                                      only_name = 1;
    dealii::Utilities::MPI::MPI_InitFinalize mpi(only_name, argv, 1);
    // The reader of the log may end before the run; Open MPI handles SIGPIPE in
    // another way.
    std::signal(SIGPIPE, SIG_IGN);
    for (const int signal : ignored) // MPI may have set them
      std::signal(signal, SIG_IGN);
    status = run_command(command, with_bars);
  }
  if (with_bars.empty() || !is_first_process())
    return status;
  std::optional<double> seconds;
  if (command.wall_time > 0.)
    seconds =
      command.wall_time - duration<double>(steady_clock::now() - start).count();
  return add_bars(command, with_bars, seconds);
}
