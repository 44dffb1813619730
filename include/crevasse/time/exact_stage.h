// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_time_exact_stage_h
#define crevasse_time_exact_stage_h

#include <crevasse/time/rate_equation.h>

#include <functional>
#include <sundials/sundials_nonlinearsolver.h>

namespace Crevasse
{
  /**
   * What ARKODE takes for a nonlinear solver: the stages z = z_p + z_c of a
   * diagonally implicit method are the solutions of
   *
   *     z_c = d + γΔt f(z_p + z_c, t)
   *
   * with what is known, d, from the earlier stages (SUNDIALS 6.4, ARKODE,
   * "Nonlinear solver methods"). That is r = r̂ + c f(r,t) with r̂ = z_p + d and
   * c = γΔt: RateEquation::implicit_rate solves it, once and exactly.
   */
  class ExactStage
  {
  public:
    /** f of the stage at t with r̂ and c; nonzero if that failed. */
    using Solve = std::function<
      int(const double t, const Vector &known, const double c, Vector &rate)>;

    ExactStage(const Solve &solve, const SUNContext context);

    ~ExactStage();

    ExactStage(const ExactStage &) = delete;
    ExactStage &
    operator=(const ExactStage &) = delete;

    /** For ARKStepSetNonlinearSolver; it must not be used after this object. */
    SUNNonlinearSolver
    solver()
    {
      return handle;
    }

  private:
    /** @param[out] correction z_c */
    int
    solve_stage(void *arkode_memory, N_Vector correction);

    const Solve        solve;
    SUNNonlinearSolver handle;
    Vector             known, rate;
  };
} // namespace Crevasse

#endif
