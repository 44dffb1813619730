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
   * solution. A solution beyond the tolerance is an exception.
   */
  class ContactSolver
  {
  public:
    ContactSolver(const SignoriniProblem &problem, const double tolerance);
    virtual ~ContactSolver() = default;

    /**
     * @param[in,out] solution Initial guess of iterative methods; then q.
     * @param[out] contact_forces of each locally owned bound.
     * @param stiffness_factor k > 0, if the problem is that of k A: with b / k
     * for b it is that of A, with forces g / k.
     * @param friction for bounds with tangents; null without friction.
     * @throw NumericalError with certificate and advice if no solution within
     * the tolerance was found.
     */
    void
    solve(const Vector        &right_hand_side,
          Vector              &solution,
          ContactForces       &contact_forces,
          const double         stiffness_factor = 1.,
          const FrictionState *friction         = nullptr);

    /** Solves without friction, for the normal forces alone. */
    void
    solve(const Vector        &right_hand_side,
          Vector              &solution,
          std::vector<double> &normal_forces,
          const double         stiffness_factor = 1.)
    {
      ContactForces forces;
      forces.normal.swap(normal_forces);
      solve(right_hand_side, solution, forces, stiffness_factor);
      forces.normal.swap(normal_forces);
    }

    /** Complementarity function φ = L q − gap − κg of each locally owned bound,
     * with κ = 1/(k A_ii): positive where open, negative where closed. */
    void
    complementarity_functions(const Vector              &solution,
                              const std::vector<double> &contact_forces,
                              const double               stiffness_factor,
                              std::vector<double>       &values) const;

    /** Function ψ of each locally owned bound with friction, see
     * RateEquation::switching_functions(). */
    void
    stick_functions(const Vector        &solution,
                    const ContactForces &contact_forces,
                    const double         stiffness_factor,
                    const FrictionState &state,
                    std::vector<double> &values) const;

    /** Sets the force relative to which errors are measured: see Scales. */
    void
    set_force_scale(const double largest_nodal_force)
    {
      load = largest_nodal_force;
    }

    /** Largest entry of a residual of the last solved problem, of k A, relative
     * to its forces: see Scales. */
    double
    relative_to_forces(const Vector &residual, const double k) const
    {
      return residual.linfty_norm() / (k * scales.force());
    }

    /** Records the relative residual of Newton's method for nonlinear creep. */
    void
    note_newton_residual(const double relative_residual)
    {
      counts.certificate.newton_residual =
        std::max(counts.certificate.newton_residual, relative_residual);
    }

    /** Whether each locally owned bound bears more than rounding in the last
     * solution; empty before the first solution. */
    std::vector<bool>
    closed_bounds() const;

    /** Sets the first guess of the closed bounds, if the method uses one.
     * Collective. */
    virtual void
    start_from([[maybe_unused]] const std::vector<bool> &closed_bounds)
    {
    }

    /** Serialises the state that the next solution depends on, besides its
     * initial guess, alike for all methods: another method may resume. */
    void
    serialize(StateArchive &archive);

    /** Counts and largest errors of all solves so far. Linear solves and
     * iterations are those of the contact method, without those of its linear
     * solver. */
    const SolverStatistics &
    statistics() const
    {
      return counts;
    }

    /** Bytes on this rank, without the linear solver. */
    virtual std::size_t
    memory_consumption() const;

    /** Whether solutions do not depend on where the iteration starts. */
    virtual bool
    is_exact() const
    {
      return false;
    }

    /** Name and settings of the method for the log and the summary. */
    virtual std::string
    description() const = 0;

  protected:
    /** Improves @p solution until its certificate is within the tolerance or no
     * progress is possible; returns the number of iterations. */
    virtual std::size_t
    iterate(const Vector &right_hand_side, Vector &solution) = 0;

    /** First active set of the next solve, for each locally owned bound; empty
     * if there is none. */
    virtual std::vector<bool>
    first_set() const
    {
      return {};
    }

    /** Serialises what else the next solution depends on. */
    virtual void
    serialize_states(StateArchive &)
    {
    }

    /** Factor that affects rounding in the next solution; null if none. */
    virtual PrincipalFactor *
    lip_factor()
    {
      return nullptr;
    }

    /** Details of a failure for its message: sentences that begin with a space.
     */
    virtual std::string
    failure_notes() const
    {
      return "";
    }

    /** Tolerance of forces: the parameter, or more if rounding requires. */
    double
    force_accuracy() const
    {
      return std::max(tolerance, scales.force_rounding());
    }

    /** Tolerance of displacements: the parameter, or more for rounding. */
    double
    displacement_accuracy() const
    {
      return std::max(tolerance, scales.displacement_rounding());
    }

    /** Sets the scales to the maxima of all solutions and a candidate. */
    void
    scale_by(const Vector &right_hand_side, const Vector &candidate);

    /** Whether the certificate of a candidate is within the tolerances. */
    bool
    is_solved(const Vector &right_hand_side, const Vector &candidate)
    {
      return accepts(certify(right_hand_side, candidate));
    }

    /** Target of the l₂ norm of linear residuals for the certificate, which
     * uses the maximum norm: the l₂ norm is never smaller. */
    double
    residual_target() const
    {
      return 0.5 * force_accuracy() * scales.force();
    }

    /** Force that stops no motion: as in ContactBoundary, rounding errors of
     * loads do not. */
    double
    negligible_force() const
    {
      return std::max(residual_target(), 1e-9 * scales.force());
    }

    /** Solves A x = b as the certificate requires, from @p solution on. */
    void
    solve_linear(LinearSolver &linear_solver,
                 const Vector &right_hand_side,
                 Vector       &solution);

    const SignoriniProblem &problem;
    const double            tolerance;
    const FrictionState    *friction = nullptr; ///< of the problem being solved
    Scales                  scales;             ///< maxima with the candidate
    SolverStatistics        counts;

  private:
    /** Certifies a candidate, using the work space of this object. */
    Certificate
    certify(const Vector &right_hand_side, const Vector &solution);

    bool
    accepts(const Certificate &certificate) const;

    [[noreturn]] void
    fail(const Certificate &certified, const std::size_t n_iterations) const;

    double        load = 0.; ///< from set_force_scale()
    Scales        scales_of_solutions;
    Vector        scaled_right_hand_side; ///< empty until first used
    Vector        residual;
    ContactForces forces;
  };
} // namespace Crevasse

#endif
