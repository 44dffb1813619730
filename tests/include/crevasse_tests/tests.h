// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_tests_tests_h
#define crevasse_tests_tests_h

#include <crevasse/base/single_process.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iostream>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

/** Counts what failed, so that a test ends with a status. */
inline int n_failures = 0;

/** What the lines of the checks begin with: the test and its section. */
inline std::string current_test, heading;

/** Names what is checked from here on, so that no two lines are the same. */
inline void
section(const std::string &name)
{
  heading = current_test + ", " + name + ": ";
}

/** Prints "name: yes" if value ≤ bound (nan fails); otherwise "NO", and the
 * value as an error. */
inline void
check_below(const std::string &name, const double value, const double bound)
{
  const bool passed = value <= bound;
  std::cout << heading << name << " below " << bound << ": "
            << (passed ? "yes" : "NO") << std::endl;
  if (!passed)
    {
      std::cerr << heading << name << " is " << value << std::endl;
      ++n_failures;
    }
}

inline void
check(const std::string &name, const bool passed)
{
  std::cout << heading << name << ": " << (passed ? "yes" : "NO") << std::endl;
  n_failures += passed ? 0 : 1;
}

/** Larger random families and finer meshes, with CREVASSE_TESTS=full in the
 * environment: they print the same lines. */
inline bool
is_full()
{
  const char *tier = std::getenv("CREVASSE_TESTS");
  return tier != nullptr && std::string(tier) == "full";
}

/** Runs tests one after the other, or those that the command line names. An
 * exception ends a test, not the others. Only the first rank prints, all of
 * them return whether something has failed. */
inline int
run_tests(int                                                    argc,
          char                                                 **argv,
          const std::vector<std::pair<std::string, void (*)()>> &tests)
{
  Crevasse::set_up_single_process();
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  std::ostringstream                       nowhere;
  const auto                               standard_output = std::cout.rdbuf();
  if (dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) != 0)
    std::cout.rdbuf(nowhere.rdbuf());
  const std::vector<std::string> chosen(argv + 1, argv + argc);
  for (const auto &[name, test] : tests)
    {
      if (!chosen.empty() &&
          std::find(chosen.begin(), chosen.end(), name) == chosen.end())
        continue;
      current_test = name;
      heading      = name + ": ";
      try
        {
          test();
        }
      catch (const std::exception &error)
        {
          check("no exception", false);
          std::cerr << error.what() << std::endl;
        }
    }
  std::cout.rdbuf(standard_output);
  return n_failures == 0 ? 0 : 1;
}

#endif
