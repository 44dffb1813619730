// ---------------------------------------------------------------------
//
// Copyright (C) 2026 by the Crevasse authors
//
// This file is part of Crevasse. It is free software; you can use it,
// redistribute it and/or modify it under the terms of the GNU Lesser
// General Public License as published by the Free Software Foundation;
// either version 2.1 of the License, or (at your option) any later version.
//
// ---------------------------------------------------------------------

#ifndef crevasse_time_arkode_driver_h
#define crevasse_time_arkode_driver_h

#include <crevasse/time/aligned_steps.h>
#include <crevasse/time/arkode_table.h>
#include <crevasse/time/event_functions.h>
#include <crevasse/time/exact_stage.h>
#include <crevasse/time/remembered_rate.h>

#include <deal.II/sundials/arkode.h>
#include <deal.II/sundials/n_vector.h>

#include <exception>
#include <memory>
#include <string>
#include <type_traits>

namespace Crevasse
{
  /**
   * ARKODE as Arkode uses it: deal.II's wrapper for its memory and vectors, and
   * step by step its own functions, with every return code checked (deal.II 9.4
   * does that in debug mode only). Exceptions are kept while C code is on the
   * stack.
   */
  class ArkodeDriver : private dealii::SUNDIALS::ARKode<Vector>
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
    /** Options that deal.II's wrapper has not. */
    void
    set_up(void *memory);

    void
    set_step_control(void *memory);

    /** Runs @p evaluate and returns 0; else keeps what it threw. */
    template <typename Evaluate>
    int
    guarded(const Evaluate &evaluate);

    /** @throw what was kept; or NumericalError if the code is negative. */
    void
    check(const int code);

    static int
    root_function(realtype t, N_Vector y, realtype *values, void *user_data);

    static int
    choose_step(N_Vector,
                realtype t,
                realtype last,
                realtype,
                realtype,
                realtype error,
                realtype,
                realtype,
                int,
                int       embedded_order,
                realtype *step,
                void     *self);

    Settings           settings;
    const ArkodeTable &table;
    RememberedRate    &equation;
    EventFunctions    *events;
    const AlignedSteps aligned_steps;

    using Context =
      std::unique_ptr<std::remove_pointer_t<SUNContext>, void (*)(SUNContext)>;
    using View = dealii::SUNDIALS::internal::NVectorView<Vector>;

    /** That of deal.II's wrapper is not to be had. */
    const Context               context;
    double                      current_time = 0.;
    Vector                      current;
    const View                  view; ///< of it: ARKODE keeps a pointer
    std::unique_ptr<ExactStage> exact_stage;
    std::exception_ptr          thrown;
    bool                        seeks_events = false;
    std::string                 words; ///< ARKODE's last message
  };
} // namespace Crevasse

#endif
