// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/model/solver_statistics.h>

#include <algorithm>

namespace Crevasse
{
  void
  SolverStatistics::add(const LinearSolver &solver)
  {
    linear_solves += solver.n_solves();
    linear_iterations += solver.n_iterations();
    back_solves += solver.n_solves();
    back_solve_time += solver.seconds();
  }



  void
  SolverStatistics::add(const ContactSolver &solver)
  {
    linear_solves += solver.n_linear_solves();
    linear_iterations += solver.n_linear_iterations();
    if (solver.has_bounds())
      {
        vi_solves += solver.n_solves();
        vi_iterations += solver.n_iterations();
        vi_time += solver.seconds();
      }
    certified += solver.n_solves();
    certificate.merge(solver.worst_certificate());
    accuracy = std::max(accuracy, solver.accuracy());
  }



  void
  SolverStatistics::add(const SolverStatistics &other)
  {
    assemblies += other.assemblies;
    factorisations += other.factorisations;
    multigrid_setups += other.multigrid_setups;
    linear_solves += other.linear_solves;
    linear_iterations += other.linear_iterations;
    back_solves += other.back_solves;
    back_solve_time += other.back_solve_time;
    vi_solves += other.vi_solves;
    vi_iterations += other.vi_iterations;
    vi_time += other.vi_time;
    certified += other.certified;
    certificate.merge(other.certificate);
    accuracy = std::max(accuracy, other.accuracy);
  }



  void
  SolverStatistics::add_to(Summary &summary) const
  {
    auto &counters                = summary["counters"];
    counters["assemblies"]        = assemblies;
    counters["factorisations"]    = factorisations;
    counters["multigrid_setups"]  = multigrid_setups;
    counters["linear_solves"]     = linear_solves;
    counters["linear_iterations"] = linear_iterations;
    counters["vi_solves"]         = vi_solves;
    counters["vi_iterations"]     = vi_iterations;

    summary["certificate"] = {{"penetration", certificate.penetration},
                              {"tension", certificate.tension},
                              {"complementarity", certificate.complementarity},
                              {"residual", certificate.residual},
                              {"accuracy", accuracy}};
    if (vi_solves > 0)
      summary["seconds"]["vi_mean"] = vi_time / vi_solves;
    if (back_solves > 0)
      summary["seconds"]["back_solve_mean"] = back_solve_time / back_solves;
  }
} // namespace Crevasse
