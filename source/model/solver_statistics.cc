// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/model/solver_statistics.h>

#include <algorithm>
#include <utility>

namespace Crevasse
{
  namespace
  {
    /** Those of summary.json. */
    constexpr std::pair<const char *, std::size_t SolverStatistics::*>
      counters[] = {{"assemblies", &SolverStatistics::assemblies},
                    {"factorisations", &SolverStatistics::factorisations},
                    {"multigrid_setups", &SolverStatistics::multigrid_setups},
                    {"linear_solves", &SolverStatistics::linear_solves},
                    {"linear_iterations", &SolverStatistics::linear_iterations},
                    {"vi_solves", &SolverStatistics::vi_solves},
                    {"vi_iterations", &SolverStatistics::vi_iterations}};
  } // namespace



  void
  SolverStatistics::add(const SolverStatistics &other)
  {
    for (const auto &[name, counter] : counters)
      this->*counter += other.*counter;
    back_solves += other.back_solves;
    back_solve_time += other.back_solve_time;
    vi_time += other.vi_time;
    lip_time += other.lip_time;
    certificate_time += other.certificate_time;
    certified += other.certified;
    certificate.merge(other.certificate);
    accuracy = std::max(accuracy, other.accuracy);
  }



  void
  SolverStatistics::add_to(Summary &summary) const
  {
    for (const auto &[name, counter] : counters)
      summary["counters"][name] = this->*counter;
    summary["certificate"] = {{"penetration", certificate.penetration},
                              {"tension", certificate.tension},
                              {"complementarity", certificate.complementarity},
                              {"residual", certificate.residual},
                              {"accuracy", accuracy}};
    for (const auto &[name, seconds] :
         {std::pair<const char *, double>{"linear solves", back_solve_time},
          {"contact on the lip", lip_time},
          {"certificates", certificate_time}})
      if (seconds > 0.)
        summary["seconds"][name] = seconds;
    if (vi_solves > 0)
      summary["seconds"]["vi_mean"] = vi_time / vi_solves;
    if (back_solves > 0)
      summary["seconds"]["back_solve_mean"] = back_solve_time / back_solves;
  }
} // namespace Crevasse
