// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_model_contact_system_h
#define crevasse_model_contact_system_h

#include <crevasse/contact/contact_solver.h>
#include <crevasse/contact/solver_statistics.h>
#include <crevasse/discretisation/stiffness.h>
#include <crevasse/linear/multigrid_levels.h>
#include <crevasse/linear/solver_choice.h>
#include <crevasse/linear/stiffness_operator.h>

namespace Crevasse
{
  /** Settings common to the contact systems of a run. */
  struct SolverSettings
  {
    const ContactParameters      &contact;
    const LinearSolverParameters &linear_solver;
    LinearSolverChoice            linear_choice;
    ContactSolverChoice           contact_choice;

    /** Relaxation factor of projected SOR for a stiffness. */
    std::function<double(const SparseMatrix &)> relaxation_factor;
    /** Largest load, the scale of errors: see Scales. */
    double largest_load = 0.;
  };

  /**
   * A stiffness with its contact solver and linear solver. The linear solver is
   * prepared when it is first used.
   */
  template <int dim>
  class ContactSystem
  {
  public:
    /** Assembles the stiffness and prepares the contact solver. Arguments other
     * than @p stiffness and @p similar must outlive the ContactSystem.
     *
     * @param similar a system of the same space, whose sparsity pattern and
     * analysis are reused, or null.
     * @throw NumericalError if a matrix-free operator is wrong. */
    ContactSystem(const SolverSettings                &settings,
                  const Space<dim>                    &space,
                  const QuadratureField<dim>          &points,
                  const PointValues<VoigtMatrix<dim>> &stiffness,
                  const UnilateralBounds              &bounds,
                  const ContactSystem                 *similar = nullptr);

    // Members refer to each other, so the object cannot be copied.
    ContactSystem(const ContactSystem &) = delete;

    const SignoriniProblem &
    problem() const
    {
      return *signorini_problem;
    }

    ContactSolver &
    contact_solver()
    {
      return *contact;
    }

    /** Linear solver for the body with an open lip. */
    LinearSolver &
    linear_solver();

    /** Adds names of solvers and reasons for them to summary.json. */
    void
    describe(Summary &summary) const;

    SolverStatistics
    statistics() const;

    /** Bytes of the matrix and its solvers, on this rank, without what is
     * shared with a similar system. */
    std::size_t
    memory_consumption() const
    {
      return matrix.memory_consumption() +
             linear_operator->memory_consumption() + bytes_of_levels +
             contact->memory_consumption() +
             (open_solver != nullptr ? open_solver->memory_consumption() : 0);
    }

  private:
    std::unique_ptr<ContactSolver>
    make_contact_solver();

    const SolverSettings                       &settings;
    const Space<dim>                           &space;
    std::shared_ptr<const Cholesky::Factor>     analysis; ///< analysis, or null
    std::shared_ptr<const MultigridLevels<dim>> levels;   ///< levels, or null
    std::size_t bytes_of_levels = 0; ///< bytes, unless shared

    SparseMatrix                            matrix; ///< stiffness, or empty
    std::unique_ptr<const LinearOperator>   linear_operator; ///< stiffness A
    std::unique_ptr<const SignoriniProblem> signorini_problem;
    std::unique_ptr<LinearSolver>           open_solver;
    std::unique_ptr<ContactSolver>          contact;
    SolverStatistics                        setups; ///< counts of set-ups only
  };
} // namespace Crevasse

#endif
