// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_contact_contact_solver_h
#define crevasse_contact_contact_solver_h

#include <crevasse/contact/solver_statistics.h>
#include <crevasse/linear/linear_solver.h>

#include <algorithm>

namespace Crevasse
{
  class PrincipalFactor;
  class StateArchive;

  /**
   * Solves one Signorini problem for many right-hand sides and certifies every
   * solution. What is not within tolerance is thrown, never returned.
   */
  class ContactSolver
  {
  public:
    ContactSolver(const SignoriniProblem &problem, const double tolerance);
    virtual ~ContactSolver() = default;

    /**
     * @param[in,out] solution The start of iterative methods; then q.
     * @param[out] contact_forces g for each locally owned bound.
     * @param stiffness_factor k > 0, if the problem is that of k A: with b / k
     * for b it is that of A, whose forces are g / k.
     * @throw NumericalError with certificate and advice if no solution within
     * tolerance was found.
     */
    void
    solve(const Vector        &right_hand_side,
          Vector              &solution,
          std::vector<double> &contact_forces,
          const double         stiffness_factor = 1.);

    /** φ = L q − gap − κg for each locally owned bound, with κ = 1/(k A_ii):
     * positive where open, negative where closed. */
    void
    complementarity_functions(const Vector              &solution,
                              const std::vector<double> &contact_forces,
                              const double               stiffness_factor,
                              std::vector<double>       &values) const;

    /** Makes known by which force errors are to be judged: see Scales. */
    void
    set_force_scale(const double largest_nodal_force)
    {
      load = largest_nodal_force;
    }

    /** The largest entry of a residual of the problem that was solved last, of
     * k A, relative to its forces: see Scales. */
    double
    relative_to_forces(const Vector &residual, const double k) const
    {
      return residual.linfty_norm() / (k * scales.force());
    }

    /** Records the residual of Newton's method of a power law. */
    void
    note_newton_residual(const double relative_residual)
    {
      counts.certificate.newton_residual =
        std::max(counts.certificate.newton_residual, relative_residual);
    }

    /** Which of the locally owned bounds bear more than rounding in the last
     * solution; empty before there is one. */
    std::vector<bool>
    closed_bounds() const;

    /** Makes these bounds the first guess, if the method begins with one.
     * Collective. */
    virtual void
    start_from([[maybe_unused]] const std::vector<bool> &closed_bounds)
    {
    }

    /** Shows what the next solution depends on besides its start, in the same
     * way for all methods: one may go on where another one was. */
    void
    serialize(StateArchive &archive);

    /** Counts and largest errors of all solves so far. Linear solves and their
     * iterations are those of the method itself, without those of its linear
     * solver. */
    const SolverStatistics &
    statistics() const
    {
      return counts;
    }

    /** Bytes on this rank, without those of the linear solver. */
    virtual std::size_t
    memory_consumption() const;

    /** For the log and the summary: which method, with which settings. */
    virtual std::string
    description() const = 0;

  protected:
    /** Improves @p solution until its certificate is within the tolerance or
     * nothing more can be done; returns the number of iterations. */
    virtual std::size_t
    iterate(const Vector &right_hand_side, Vector &solution) = 0;

    /** The set that the next solve begins with, for each locally owned bound;
     * empty if there is none. */
    virtual std::vector<bool>
    first_set() const
    {
      return {};
    }

    /** What else rounds the next solution; null if the method has none. */
    virtual PrincipalFactor *
    lip_factor()
    {
      return nullptr;
    }

    /** What the method knows about a failure, for its message: sentences that
     * begin with a space. */
    virtual std::string
    failure_notes() const
    {
      return "";
    }

    /** The tolerance of forces, or what rounding leaves of it. */
    double
    force_accuracy() const
    {
      return std::max(tolerance, scales.force_rounding());
    }

    /** The same of displacements. */
    double
    displacement_accuracy() const
    {
      return std::max(tolerance, scales.displacement_rounding());
    }

    /** Makes the scales those of all solutions so far and a candidate. */
    void
    scale_by(const Vector &right_hand_side, const Vector &candidate);

    /** Whether the certificate of a candidate is within these. */
    bool
    is_solved(const Vector &right_hand_side, const Vector &candidate)
    {
      return accepts(certify(right_hand_side, candidate));
    }

    /** The l₂ norm of a linear residual that the certificate accepts: it is
     * never below the maximum norm of the certificate. */
    double
    residual_target() const
    {
      return 0.5 * force_accuracy() * scales.force();
    }

    /** A x = b to what the certificate accepts, with @p solution as start. */
    void
    solve_linear(LinearSolver &linear_solver,
                 const Vector &right_hand_side,
                 Vector       &solution);

    const SignoriniProblem &problem;
    const double            tolerance;
    Scales                  scales; ///< of all solutions and the candidate
    SolverStatistics        counts;

  private:
    /** Certifies into this object's own work space. */
    Certificate
    certify(const Vector &right_hand_side, const Vector &solution);

    bool
    accepts(const Certificate &certificate) const;

    [[noreturn]] void
    fail(const Certificate &certified, const std::size_t n_iterations) const;

    double              load = 0.; ///< see set_force_scale()
    Scales              scales_of_solutions;
    Vector              scaled_right_hand_side; ///< empty until one is scaled
    Vector              residual;
    std::vector<double> forces;
  };
} // namespace Crevasse

#endif
