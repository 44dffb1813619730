// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_postprocess_problem_export_h
#define crevasse_postprocess_problem_export_h

#include <crevasse/base/log.h>
#include <crevasse/contact/signorini_problem.h>
#include <crevasse/parameters/recorded_steps.h>
#include <crevasse/time/observer.h>

#include <functional>
#include <string>

namespace Crevasse
{
  /**
   * Writes contact problems of a run, so that other solvers can be tried on
   * them:
   *
   *     minimise ½qᵀAq − bᵀq,   sign q[dof] ≥ gap for the dofs of the lip.
   *
   * NAME is contact_problem_PERIOD_STEP; the files are in the formats of Matrix
   * Market and of PETSc:
   *
   * NAME_matrix.mtx, NAME_right_hand_side.mtx: A and b. NAME_lip.mtx: one row
   * for each bound: dof (counted from 0), sign, gap. NAME_solution.mtx: q.
   * NAME.petsc: for MatLoad and then VecLoad, A, b, the lower and the upper
   * bound of all unknowns (∓PETSC_INFINITY where there is none), q.
   */
  class ProblemExport : public Observer
  {
  public:
    /** The problem of the instant that is observed, without the factor of its
     * stiffness. */
    using CurrentProblem = std::function<const SignoriniProblem &()>;

    ProblemExport(const CurrentProblem &problem,
                  const RecordedSteps  &steps,
                  Log                  &log,
                  const std::string    &directory);

    /** @throw FileError */
    void
    observe(const Sample &sample) override;

    void
    serialize(StateArchive &archive) override;

    /** Says in the log which steps the run has not come to. */
    void
    summarise(Summary &) override;

  private:
    const CurrentProblem problem;
    RecordedSteps        missing;
    Log                 &log;
    const std::string    directory;
  };

  /** Writes one problem with the solution @p q to files that begin with
   * @p name. Collective. @throw FileError */
  void
  write_matrix_market(const SignoriniProblem &problem,
                      const Vector           &right_hand_side,
                      const Vector           &solution,
                      const std::string      &name);

  void
  write_petsc_binary(const SignoriniProblem &problem,
                     const Vector           &right_hand_side,
                     const Vector           &solution,
                     const std::string      &name);
} // namespace Crevasse

#endif
