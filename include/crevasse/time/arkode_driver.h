// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_time_arkode_driver_h
#define crevasse_time_arkode_driver_h

#include <crevasse/time/aligned_steps.h>
#include <crevasse/time/arkode_table.h>
#include <crevasse/time/event_functions.h>
#include <crevasse/time/exact_stage.h>
#include <crevasse/time/remembered_rate.h>
#include <crevasse/time/sundials.h>

#include <deal.II/sundials/n_vector.h>

#include <exception>
#include <memory>
#include <string>

namespace Crevasse
{
  /**
   * ARKODE as Arkode uses it: its own functions on deal.II's vectors, with
   * every return code checked. (deal.II's class ARKode has not these steps and
   * events, and hides the context in which messages are caught.) Exceptions are
   * kept while C code is on the stack.
   */
  class ArkodeDriver
  {
  public:
    struct Settings
    {
      bool   is_implicit;
      double period;      ///< no step goes beyond
      double unit;        ///< of the AlignedSteps of an implicit method
      bool   is_adaptive; ///< else steps are as long as fix_step() says
      /** Error of r that a step may make, in the root mean square of all
       * entries divided by theirs; empty if steps are fixed. */
      Vector tolerances;
    };

    /** Begins at t = 0. All arguments but @p settings must outlive this.
     *
     * @param step the first that is tried.
     * @param events null: none are sought. */
    ArkodeDriver(const Settings    &settings,
                 const ArkodeTable &table,
                 RememberedRate    &equation,
                 EventFunctions    *events,
                 const double       step,
                 const Vector      &r);

    /** Goes on from here. */
    void
    restart(const double t, const double step, const Vector &r);

    /** The next step ends at this instant. */
    void
    fix_step(const double step, const double end);

    /** No step goes beyond this instant until restart(). */
    void
    stop_at(const double t);

    /** Whether steps end at events. */
    void
    seek_events(const bool on);

    /** One step, or as much of it as there is before an event: whether one was
     * found. */
    bool
    step();

    /** Where the last step or event was. */
    double
    time() const;

    /** r there. */
    const Vector &
    state() const;

    /** The step that is tried next. */
    double
    next_step() const;

    /** r at an instant of the last step. */
    void
    interpolate(const double t, Vector &r);

    /** Steps, rejected steps, and stages that failed. */
    IntegratorStatistics
    statistics() const;

  private:
    void
    set_method();

    void
    set_step_control();

    /** Runs @p evaluate and returns 0; else keeps what it threw. */
    template <typename Evaluate>
    int
    guarded(const Evaluate &evaluate);

    /** @throw what was kept; or NumericalError if the code is negative. */
    void
    check(const int code);

    static int
    right_hand_side(sunrealtype t, N_Vector y, N_Vector f, void *self);

    static int
    root_function(sunrealtype t, N_Vector y, sunrealtype *values, void *self);

    static int
    choose_step(N_Vector,
                sunrealtype t,
                sunrealtype last,
                sunrealtype,
                sunrealtype,
                sunrealtype error,
                sunrealtype,
                sunrealtype,
                int,
                int          embedded_order,
                sunrealtype *step,
                void        *self);

    Settings           settings;
    const ArkodeTable &table;
    RememberedRate    &equation;
    EventFunctions    *events;
    const AlignedSteps aligned_steps;

    using View   = dealii::SUNDIALS::internal::NVectorView<Vector>;
    using Memory = std::unique_ptr<void, void (*)(void *)>;

    std::string                 words; ///< SUNDIALS' last message
    const SundialsContext       context;
    double                      current_time = 0.;
    Vector                      current;
    const View                  view;   ///< of it: ARKODE keeps a pointer
    const Memory                memory; ///< ARKODE's
    std::unique_ptr<ExactStage> exact_stage;
    std::exception_ptr          thrown;
    bool                        seeks_events = false;
  };
} // namespace Crevasse

#endif
