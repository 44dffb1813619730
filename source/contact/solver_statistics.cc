// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/contact/solver_statistics.h>

#include <algorithm>
#include <utility>

namespace Crevasse
{
  namespace
  {
    /** Names and values of the counters in summary.json. */
    constexpr std::pair<const char *, std::size_t SolverStatistics::*>
      counters[] = {{"assemblies", &SolverStatistics::assemblies},
                    {"factorisations", &SolverStatistics::factorisations},
                    {"multigrid_setups", &SolverStatistics::multigrid_setups},
                    {"linear_solves", &SolverStatistics::linear_solves},
                    {"linear_iterations", &SolverStatistics::linear_iterations},
                    {"vi_solves", &SolverStatistics::vi_solves},
                    {"vi_iterations", &SolverStatistics::vi_iterations},
                    {"implicit_stages", &SolverStatistics::implicit_stages},
                    {"rate_evaluations", &SolverStatistics::rate_evaluations}};
  } // namespace



  void
  SolverStatistics::add(const SolverStatistics &other)
  {
    for (const auto &[name, counter] : counters)
      this->*counter += other.*counter;
    certified += other.certified;
    undetermined += other.undetermined;
    certificate.merge(other.certificate);
    accuracy = std::max(accuracy, other.accuracy);
  }



  void
  SolverStatistics::add_counters(Summary &summary) const
  {
    for (const auto &[name, counter] : counters)
      summary["counters"][name] = this->*counter;
  }



  void
  SolverStatistics::add_certificate(Summary &summary) const
  {
    summary["certificate"].update(
      {{"penetration", certificate.penetration},
       {"tension", certificate.tension},
       {"complementarity", certificate.complementarity},
       {"residual", certificate.residual},
       {"accuracy", accuracy}});
    if (certificate.friction > 0.)
      summary["certificate"]["friction"] = certificate.friction;
    if (implicit_stages > 0)
      summary["certificate"]["newton_residual"] = certificate.newton_residual;
  }
} // namespace Crevasse
