// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/problems.h>
#include <crevasse/base/text.h>
#include <crevasse/contact/solver_statistics.h>

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
                    {"vi_iterations", &SolverStatistics::vi_iterations},
                    {"implicit_stages", &SolverStatistics::implicit_stages}};
  } // namespace



  void
  SolverStatistics::add(const SolverStatistics &other)
  {
    for (const auto &[name, counter] : counters)
      this->*counter += other.*counter;
    certified += other.certified;
    undetermined += other.undetermined;
    never_held &= other.never_held;
    certificate.merge(other.certificate);
    accuracy = std::max(accuracy, other.accuracy);
  }



  void
  SolverStatistics::require_held(const std::vector<RigidMotion> &motions) const
  {
    std::vector<std::string> names;
    for (unsigned int m = 0; m < motions.size() && m < 64; ++m)
      if (certified > 0 && (never_held >> m & 1) == 1)
        names.push_back(motions[m].name);
    if (!names.empty())
      throw NumericalError(
        "Unconstrained rigid-body motions:\n  " + Text::join(names, "\n  ") +
        "\nContact could stop them, but no load presses a lip that does: "
        "nothing tells where the part is. Hold it by [Boundary] Clamped, "
        "Symmetry or Fixed points, or load it.");
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
    if (implicit_stages > 0)
      summary["certificate"]["newton_residual"] = certificate.newton_residual;
  }
} // namespace Crevasse
