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

#include <crevasse/scene/problems.h>
#include <crevasse/time/arkode_driver.h>
#include <crevasse/time/arkode_failure.h>

#include <deal.II/sundials/n_vector.h>

#include <algorithm>
#include <arkode/arkode_arkstep.h>
#include <cmath>
#include <limits>
#include <utility>

namespace Crevasse
{
  using dealii::SUNDIALS::internal::make_nvector_view;
  using dealii::SUNDIALS::internal::unwrap_nvector_const;

  namespace
  {
    using Wrapper = dealii::SUNDIALS::ARKode<Vector>;

    /** Of the step that an error estimate asks for; ARKODE's own. */
    constexpr double arkode_safety = 0.96;



    Wrapper::AdditionalData
    wrapper_settings(const ArkodeDriver::Settings &settings,
                     const ArkodeTable            &table)
    {
      Wrapper::AdditionalData data;
      data.final_time    = settings.period;
      data.maximum_order = table.table()->q;
      if (settings.is_adaptive)
        data.relative_tolerance = 0.;
      data.anderson_acceleration_subspace = 0; // not used, see ExactStage
      return data;
    }



    SUNContext
    make_context()
    {
      SUNContext context = nullptr;
      SUNContext_Create(nullptr, &context);
      AssertThrow(context != nullptr, dealii::ExcOutOfMemory(0));
      return context;
    }
  } // namespace



  template <typename Evaluate>
  int
  ArkodeDriver::guarded(const Evaluate &evaluate)
  {
    try
      {
        evaluate();
        return 0;
      }
    catch (...)
      {
        if (!thrown)
          thrown = std::current_exception();
        return -1;
      }
  }



  ArkodeDriver::ArkodeDriver(const Settings    &settings,
                             const ArkodeTable &table,
                             RememberedRate    &equation,
                             EventFunctions    *events,
                             const double       step,
                             const Vector      &r)
    : Wrapper(wrapper_settings(settings, table), r.get_mpi_communicator())
    , settings(settings)
    , table(table)
    , equation(equation)
    , events(events)
    , aligned_steps(settings.unit)
    , context(make_context(),
              [](SUNContext pointer) { SUNContext_Free(&pointer); })
    , current(r)
    , view(make_nvector_view(current, context.get()))
  {
    auto &right_hand_side =
      settings.is_implicit ? implicit_function : explicit_function;
    right_hand_side = [this](const double t, const Vector &y, Vector &f) {
      return guarded([&]() { this->equation.rate(t, y, f); });
    };
    if (settings.is_adaptive)
      get_local_tolerances = [this]() -> Vector & {
        return this->settings.tolerances;
      };
    custom_setup = [this](void *memory) { set_up(memory); };
    reset(0., step, r);
  }



  void
  ArkodeDriver::set_up(void *memory)
  {
    check(ARKStepSetErrHandlerFn(
      memory,
      [](int, const char *, const char *, char *message, void *self) {
        static_cast<ArkodeDriver *>(self)->words = message;
      },
      this));
    const ARKodeButcherTable tables = table.table();
    check(ARKStepSetTables(memory,
                           tables->q,
                           tables->p,
                           settings.is_implicit ? tables : nullptr,
                           settings.is_implicit ? nullptr : tables));
    if (settings.is_implicit)
      {
        exact_stage = std::make_unique<ExactStage>(
          [this](
            const double t, const Vector &known, const double c, Vector &rate) {
            return guarded(
              [&]() { equation.implicit_rate(t, known, c, rate); });
          },
          context.get());
        check(ARKStepSetNonlinearSolver(memory, exact_stage->solver()));
        // An exact stage has told its rate.
        check(ARKStepSetDeduceImplicitRhs(memory, 1));
      }
    // ARKODE lowers it to one below the order of the method. From 4 on each
    // instant between steps takes evaluations, which steps of a list have not.
    const int degree = settings.is_adaptive ? ARK_INTERP_MAX_DEGREE : 3;
    check(ARKStepSetInterpolantType(memory, ARK_INTERP_HERMITE));
    check(ARKStepSetInterpolantDegree(memory, degree));
    if (settings.is_adaptive)
      set_step_control(memory);
  }



  void
  ArkodeDriver::set_step_control(void *memory)
  {
    constexpr double shortest = 1e-12; // of the period
    check(ARKStepSetMinStep(memory, shortest * settings.period));
    check(ARKStepSetSafetyFactor(memory, arkode_safety));
    // What is constant for a while asks for steps that miss what comes after.
    constexpr double longest = 1. / 4.;
    check(ARKStepSetMaxStep(memory, longest * settings.period));
    if (settings.is_implicit)
      {
        check(ARKStepSetAdaptivityFn(memory, &choose_step, this));
        // Each of these would shorten a step to one that is not aligned.
        check(ARKStepSetSmallNumEFails(memory, 1000));
        check(ARKStepSetFixedStepBounds(memory, 1., 1.));
      }
    if (events != nullptr)
      seek_events(true);
  }



  int
  ArkodeDriver::root_function(realtype  t,
                              N_Vector  y,
                              realtype *values,
                              void     *user_data)
  {
    // What deal.II's wrapper has given is itself.
    auto *self = static_cast<ArkodeDriver *>(static_cast<Wrapper *>(user_data));
    return self->guarded([&]() {
      self->events->evaluate(t, *unwrap_nvector_const<Vector>(y), values);
    });
  }



  int
  ArkodeDriver::choose_step(N_Vector,
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
                            void     *self)
  {
    constexpr double smallest = std::numeric_limits<double>::min();
    const double     wish =
      last * std::pow(std::max(error, smallest), -1. / (embedded_order + 1));
    const double next = static_cast<ArkodeDriver *>(self)->aligned_steps.next(
      t, last, arkode_safety * wish);
    *step = next / arkode_safety; // ARKODE multiplies by it
    return 0;
  }



  void
  ArkodeDriver::check(const int code)
  {
    if (thrown)
      std::rethrow_exception(std::exchange(thrown, nullptr));
    if (code < 0)
      throw NumericalError(describe_arkode_failure(code, current_time, words));
  }



  void
  ArkodeDriver::restart(const double t, const double step, const Vector &r)
  {
    void *memory = get_arkode_memory();
    current      = r;
    current_time = t;
    check(ARKStepReset(memory, t, view));
    check(ARKStepSetInitStep(memory, step));
    check(ARKStepSetStopTime(memory, settings.period));
  }



  void
  ArkodeDriver::fix_step(const double step, const double end)
  {
    check(ARKStepSetFixedStep(get_arkode_memory(), step));
    check(ARKStepSetStopTime(get_arkode_memory(), end));
  }



  void
  ArkodeDriver::stop_at(const double t)
  {
    check(ARKStepSetStopTime(get_arkode_memory(), t));
  }



  void
  ArkodeDriver::seek_events(const bool on)
  {
    void *memory = get_arkode_memory();
    seeks_events = on;
    const int n  = on ? events->count(current) : 0;
    check(ARKStepRootInit(memory, n, n > 0 ? &root_function : nullptr));
    check(ARKStepSetNoInactiveRootWarn(memory));
  }



  bool
  ArkodeDriver::step()
  {
    const auto evolve = [this]() {
      return ARKStepEvolve(get_arkode_memory(),
                           settings.period,
                           view,
                           &current_time,
                           ARK_ONE_STEP);
    };
    const int code = evolve();
    if (code == ARK_ILL_INPUT && seeks_events && !thrown)
      {
        // It does not go on from a root beside which the function is zero, as
        // in the band of EventFunctions. A step on, it does.
        seek_events(false);
        check(evolve());
        seek_events(true);
        restart(current_time, next_step(), Vector(current));
        return false;
      }
    check(code);
    return code == ARK_ROOT_RETURN;
  }



  double
  ArkodeDriver::time() const
  {
    return current_time;
  }



  const Vector &
  ArkodeDriver::state() const
  {
    return current;
  }



  double
  ArkodeDriver::next_step() const
  {
    double step;
    ARKStepGetCurrentStep(get_arkode_memory(), &step);
    return step;
  }



  void
  ArkodeDriver::interpolate(const double t, Vector &r)
  {
    check(ARKStepGetDky(
      get_arkode_memory(), t, 0, make_nvector_view(r, context.get())));
  }



  IntegratorStatistics
  ArkodeDriver::statistics() const
  {
    void    *memory = get_arkode_memory();
    long int steps, rejected, failed;
    ARKStepGetNumSteps(memory, &steps);
    ARKStepGetNumErrTestFails(memory, &rejected);
    ARKStepGetNumStepSolveFails(memory, &failed);
    return {{"steps", steps},
            {"rejected_steps", rejected},
            {"convergence_failures", failed}};
  }
} // namespace Crevasse
