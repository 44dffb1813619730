// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_app_run_command_h
#define crevasse_app_run_command_h

#include <crevasse/app/command_line.h>

namespace Crevasse
{
  /** Runs, resumes or checks the scene of a command, and turns exceptions into
   * messages. Collective.
   * @param with_bars becomes the output directory if the run is done and is to
   * have error bars, which add_bars() finds.
   * @return the exit status. */
  int
  run_command(const Command &command, std::string &with_bars);

  /** Prints parameters without MPI, whose start would take longer: a sweep asks
   * for each point. With mpirun only the first process answers.
   * @return the exit status. */
  int
  show_parameters(const Command &command);

  /** `crevasse evaluate NAME FORMULA T...`: prints the values of a closed form,
   * a line each, to the Python package.
   * @return the exit status. */
  int
  evaluate(const std::vector<std::string> &words);

  /** `crevasse growth FILE SCENE [--set ...]`: prints growth by fatigue and by
   * creep over a period, a line for each row of the file, to the Python
   * package; see growth_of_histories().
   * @return the exit status. */
  int
  print_growth(const std::vector<std::string> &words);
} // namespace Crevasse

#endif
