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
   * ARKODE as Arkode uses it: its own functions on deal.II's vectors, with
   * every return code checked. (deal.II's class ARKode has no events and hides
   * the context in which messages are caught.) Exceptions are kept while C code
   * is on the stack. SUNDIALS 7 has the names ARKStep… of 6 too.
   */
  class ArkodeDriver
  {
  public:
    /** Begins at (t, r). The equation must have been evaluated there, and
     * outlive this object. The table is copied. */
    ArkodeDriver(const bool               is_implicit,
                 const ARKodeButcherTable table,
                 CachedRate              &equation,
                 const double             t,
                 const Vector            &r);

    /** Makes evolve() possible.
     *
     * @param tolerances Error of r that a step may make, in the root mean
     * square of all entries divided by theirs. */
    void
    control_steps(Vector tolerances);

    /** From now on ARKODE's steps are at most as long as this over the rate at
     * which the stress relaxes (RateEquation::relaxation_rate). */
    void
    limit_steps(const double stability_limit);

    /** From now on evolve() stops at the roots of the switching functions of
     * all contact nodes (RateEquation::switching_functions). */
    void
    seek_events();

    /** Continues from (t, r). @param is_new Whether ARKODE estimates the next
     * step without what it knows of the last ones. */
    void
    restart(const double t, const Vector &r, const bool is_new);

    /** One step of this length. */
    void
    fixed_step(const double step);

    /** The same by ARKODE's own steps, of which the first has this length and
     * the error of control_steps() or is cut. */
    void
    controlled_step(const double step);

    /** ARKODE's own steps up to @p end, where the last one ends, or to an
     * event: whether there is one. */
    bool
    evolve(const double end);

    /** The instant of state(). */
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

    /** Steps, rejected steps, and stages that failed. */
    IntegratorStatistics
    statistics() const;

  private:
    void
    collect_messages();

    void
    solve_stages_exactly();

    int
    solve_stage(N_Vector correction);

    /** Runs @p evaluate and returns 0; else keeps what it threw. */
    template <typename Evaluate>
    int
    guarded(const Evaluate &evaluate);

    /** @throw what was kept; or NumericalError if the code is negative. */
    int
    check(const int code);

    /** Of all ranks, from the equation's last evaluation. */
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
    std::string        words; ///< SUNDIALS' last message
    const Context      context;
    double             current_time;
    Vector             current;
    const View         view;        ///< of it: ARKODE keeps a pointer
    const Memory       memory;      ///< ARKODE's
    const Solver       solver;      ///< of implicit stages
    Vector             known, rate; ///< of a stage
    double             limit = 0.;  ///< see limit_steps()
    std::exception_ptr thrown;
  };



  /**
   * What happened when ARKODE returned the negative @p code at the instant
   * @p t, and which parameter to change.
   *
   * @param words what ARKODE itself says.
   */
  std::string
  describe_arkode_failure(const int          code,
                          const double       t,
                          const std::string &words);
} // namespace Crevasse

#endif
