// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_time_arkode_driver_h
#define crevasse_time_arkode_driver_h

#include <crevasse/time/cached_rate.h>
#include <crevasse/time/integrator.h>

#include <deal.II/sundials/n_vector.h>

#include <arkode/arkode_butcher.h>
#include <exception>
#include <memory>
#include <sundials/sundials_nonlinearsolver.h>
#include <type_traits>

namespace Crevasse
{
  /**
   * C++ interface of ARKODE: its functions on deal.II's vectors, with every
   * return code checked. (deal.II's class ARKode has no events and hides the
   * context that catches messages.) Exceptions are stored while C code is on
   * the stack. SUNDIALS 7 still has the names ARKStep… of version 6.
   */
  class ArkodeDriver
  {
  public:
    /** Starts at (t, r). The equation must have been evaluated there, and must
     * outlive the ArkodeDriver. The table is copied. */
    ArkodeDriver(const bool               is_implicit,
                 const ARKodeButcherTable table,
                 CachedRate              &equation,
                 const double             t,
                 const Vector            &r);

    /** Lets ARKODE control the error of steps, as evolve() needs.
     *
     * @param tolerances allowed error of r in a step, for each entry, in the
     * root mean square of all entries divided by their tolerances. */
    void
    control_steps(Vector tolerances);

    /** From now on limits ARKODE's steps to @p stability_limit over the
     * relaxation rate of the stress (RateEquation::relaxation_rate). */
    void
    limit_steps(const double stability_limit);

    /** From now on stops evolve() at the roots of the switching functions of
     * all contact nodes (RateEquation::switching_functions). */
    void
    seek_events();

    /** Continues from (t, r). @param is_new whether ARKODE chooses the next
     * step without information on earlier steps. */
    void
    restart(const double t, const Vector &r, const bool is_new);

    /** Takes one step of the given length. */
    void
    fixed_step(const double step);

    /** Takes a step of this length, which ARKODE divides if its error exceeds
     * the tolerances of control_steps(). */
    void
    controlled_step(const double step);

    /** Takes ARKODE's own steps up to @p end exactly, or to an event. Returns
     * whether there is an event. */
    bool
    evolve(const double end);

    /** Instant of state(). */
    double
    time() const
    {
      return current_time;
    }

    const Vector &
    state() const
    {
      return current;
    }

    /** Numbers of steps, rejected steps and failed stages. */
    IntegratorStatistics
    statistics() const;

  private:
    void
    collect_messages();

    void
    solve_stages_exactly();

    int
    solve_stage(N_Vector correction);

    /** Calls @p evaluate and returns 0; or stores its exception. */
    template <typename Evaluate>
    int
    guarded(const Evaluate &evaluate);

    /** Checks a code. @throw the stored exception, or NumericalError if < 0. */
    int
    check(const int code);

    /** Switching functions of all ranks, from the last evaluation. */
    std::vector<double>
    switching_functions() const;

    static int
    right_hand_side(sunrealtype t, N_Vector y, N_Vector f, void *user_data);

    using Context =
      std::unique_ptr<std::remove_pointer_t<SUNContext>, void (*)(SUNContext)>;
    using View   = dealii::SUNDIALS::internal::NVectorView<Vector>;
    using Memory = std::unique_ptr<void, void (*)(void *)>;
    using Solver = std::unique_ptr<std::remove_pointer_t<SUNNonlinearSolver>,
                                   void (*)(SUNNonlinearSolver)>;

    CachedRate        &equation;
    std::string        words; ///< last message of SUNDIALS
    const Context      context;
    double             current_time;
    Vector             current;
    const View         view;        ///< ARKODE's view of `current`
    const Memory       memory;      ///< ARKODE's memory
    const Solver       solver;      ///< solver of implicit stages
    Vector             known, rate; ///< known part, rate of stage
    double             limit = 0.;  ///< limit of limit_steps()
    std::exception_ptr thrown;
  };



  /**
   * Describes the failure for which ARKODE returned the negative @p code at the
   * instant @p t, and which parameter to change.
   *
   * @param words the message of ARKODE.
   */
  std::string
  describe_arkode_failure(const int          code,
                          const double       t,
                          const std::string &words);
} // namespace Crevasse

#endif
