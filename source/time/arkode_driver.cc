// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/problems.h>
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
  using dealii::SUNDIALS::internal::unwrap_nvector;
  using dealii::SUNDIALS::internal::unwrap_nvector_const;

  namespace
  {
    /** Of the step that an error estimate asks for; ARKODE's own. */
    constexpr double arkode_safety = 0.96;



    std::unique_ptr<void, void (*)(void *)>
    make_memory(const ARKRhsFn   explicit_function,
                const ARKRhsFn   implicit_function,
                const N_Vector   state,
                const SUNContext context)
    {
      void *const memory =
        ARKStepCreate(explicit_function, implicit_function, 0., state, context);
      AssertThrow(memory != nullptr, dealii::ExcOutOfMemory(0));
      return {memory, [](void *pointer) { ARKStepFree(&pointer); }};
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
    : settings(settings)
    , table(table)
    , equation(equation)
    , events(events)
    , aligned_steps(settings.unit)
    , context(make_sundials_context())
    , current(r)
    , view(make_nvector_view(current, context.get()))
    , memory(make_memory(settings.is_implicit ? nullptr : &right_hand_side,
                         settings.is_implicit ? &right_hand_side : nullptr,
                         view,
                         context.get()))
  {
    collect_messages(memory.get(), context.get(), words);
    check(ARKStepSetUserData(memory.get(), this));
    set_method();
    if (settings.is_adaptive)
      set_step_control();
    check(ARKStepSetInitStep(memory.get(), step));
    check(ARKStepSetStopTime(memory.get(), settings.period));
  }



  void
  ArkodeDriver::set_method()
  {
    const ARKodeButcherTable tables = table.table();
    check(ARKStepSetTables(memory.get(),
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
        check(ARKStepSetNonlinearSolver(memory.get(), exact_stage->solver()));
        // An exact stage has told its rate.
        check(ARKStepSetDeduceImplicitRhs(memory.get(), 1));
      }
    // ARKODE lowers it to one below the order of the method. From 4 on each
    // instant between steps takes evaluations, which steps of a list have not.
    const int degree = settings.is_adaptive ? ARK_INTERP_MAX_DEGREE : 3;
    check(ARKStepSetInterpolantType(memory.get(), ARK_INTERP_HERMITE));
    check(ARKStepSetInterpolantDegree(memory.get(), degree));
  }



  void
  ArkodeDriver::set_step_control()
  {
    check(ARKStepSVtolerances(
      memory.get(), 0., make_nvector_view(settings.tolerances, context.get())));
    constexpr double shortest = 1e-12; // of the period
    check(ARKStepSetMinStep(memory.get(), shortest * settings.period));
    check(ARKStepSetSafetyFactor(memory.get(), arkode_safety));
    // What is constant for a while asks for steps that miss what comes after.
    constexpr double longest = 1. / 4.;
    check(ARKStepSetMaxStep(memory.get(), longest * settings.period));
    if (settings.is_implicit)
      {
        check(ARKStepSetAdaptivityFn(memory.get(), &choose_step, this));
        // Each of these would shorten a step to one that is not aligned.
        check(ARKStepSetSmallNumEFails(memory.get(), 1000));
        check(ARKStepSetFixedStepBounds(memory.get(), 1., 1.));
      }
    if (events != nullptr)
      seek_events(true);
  }



  int
  ArkodeDriver::right_hand_side(sunrealtype t,
                                N_Vector    y,
                                N_Vector    f,
                                void       *user_data)
  {
    auto *self = static_cast<ArkodeDriver *>(user_data);
    return self->guarded([&]() {
      self->equation.rate(t,
                          *unwrap_nvector_const<Vector>(y),
                          *unwrap_nvector<Vector>(f));
    });
  }



  int
  ArkodeDriver::root_function(sunrealtype  t,
                              N_Vector     y,
                              sunrealtype *values,
                              void        *user_data)
  {
    auto *self = static_cast<ArkodeDriver *>(user_data);
    return self->guarded([&]() {
      self->events->evaluate(t, *unwrap_nvector_const<Vector>(y), values);
    });
  }



  int
  ArkodeDriver::choose_step(N_Vector,
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
                            void        *self)
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
    current      = r;
    current_time = t;
    check(ARKStepReset(memory.get(), t, view));
    check(ARKStepSetInitStep(memory.get(), step));
    check(ARKStepSetStopTime(memory.get(), settings.period));
  }



  void
  ArkodeDriver::fix_step(const double step, const double end)
  {
    check(ARKStepSetFixedStep(memory.get(), step));
    check(ARKStepSetStopTime(memory.get(), end));
  }



  void
  ArkodeDriver::stop_at(const double t)
  {
    check(ARKStepSetStopTime(memory.get(), t));
  }



  void
  ArkodeDriver::seek_events(const bool on)
  {
    seeks_events = on;
    const int n  = on ? events->count(current) : 0;
    check(ARKStepRootInit(memory.get(), n, n > 0 ? &root_function : nullptr));
    check(ARKStepSetNoInactiveRootWarn(memory.get()));
  }



  bool
  ArkodeDriver::step()
  {
    const auto evolve = [this]() {
      return ARKStepEvolve(
        memory.get(), settings.period, view, &current_time, ARK_ONE_STEP);
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
    ARKStepGetCurrentStep(memory.get(), &step);
    return step;
  }



  void
  ArkodeDriver::interpolate(const double t, Vector &r)
  {
    check(
      ARKStepGetDky(memory.get(), t, 0, make_nvector_view(r, context.get())));
  }



  IntegratorStatistics
  ArkodeDriver::statistics() const
  {
    long int steps, rejected, failed;
    ARKStepGetNumSteps(memory.get(), &steps);
    ARKStepGetNumErrTestFails(memory.get(), &rejected);
    ARKStepGetNumStepSolveFails(memory.get(), &failed);
    return {{"steps", steps},
            {"rejected_steps", rejected},
            {"convergence_failures", failed}};
  }
} // namespace Crevasse
