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
  /** What the contact systems of a run have in common. */
  struct SolverSettings
  {
    const ContactParameters      &contact;
    const LinearSolverParameters &linear_solver;
    LinearSolverChoice            linear_choice;
    ContactSolverChoice           contact_choice;

    /** The factor of projected SOR for a stiffness. */
    std::function<double(const SparseMatrix &)> relaxation_factor;
    /** By which errors are judged: see Scales. */
    double largest_load = 0.;
  };

  /**
   * A stiffness and what solves with it. The linear solver is prepared when it
   * is asked for, not before.
   */
  template <int dim>
  class ContactSystem
  {
  public:
    /** Assembles, and prepares the contact solver. All arguments but
     * @p stiffness and @p similar must outlive this object.
     *
     * @param similar a system of the same space, whose sparsity pattern and its
     * analysis are used again, or null.
     * @throw NumericalError if a matrix-free operator is not the one that it
     * should be. */
    ContactSystem(const SolverSettings                &settings,
                  const Space<dim>                    &space,
                  const QuadratureField<dim>          &points,
                  const PointValues<VoigtMatrix<dim>> &stiffness,
                  const UnilateralBounds              &bounds,
                  const ContactSystem                 *similar = nullptr);

    // Its parts refer to one another.
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

    /** For the body with an open lip. */
    LinearSolver &
    linear_solver();

    /** Names and reasons for summary.json. */
    void
    describe(Summary &summary) const;

    SolverStatistics
    statistics() const;

    /** Bytes of the matrix and what solves with it, on this rank; without what
     * a similar system has made. */
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
    std::shared_ptr<const Cholesky::Factor>     analysis; ///< if there is one
    std::shared_ptr<const MultigridLevels<dim>> levels;   ///< likewise
    std::size_t bytes_of_levels = 0; ///< where they were made only

    SparseMatrix                            matrix; ///< empty: matrix-free
    std::unique_ptr<const LinearOperator>   linear_operator; ///< A
    std::unique_ptr<const SignoriniProblem> signorini_problem;
    std::unique_ptr<LinearSolver>           open_solver;
    std::unique_ptr<ContactSolver>          contact;
    SolverStatistics                        setups; ///< nothing but set-ups
  };
} // namespace Crevasse

#endif
