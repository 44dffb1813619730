// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/problems.h>
#include <crevasse/parameters/parameters.h>
#include <crevasse/time/arkode_driver.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <arkode/arkode_arkstep.h>
#include <sstream>
#include <utility>

namespace Crevasse
{
  using dealii::SUNDIALS::internal::make_nvector_view;
  using dealii::SUNDIALS::internal::unwrap_nvector;
  using dealii::SUNDIALS::internal::unwrap_nvector_const;

  namespace
  {
    /** Without a communicator: the vectors have theirs. */
    SUNContext
    make_context()
    {
      SUNContext context = nullptr;
#if DEAL_II_SUNDIALS_VERSION_GTE(7, 0, 0)
      SUNContext_Create(SUN_COMM_NULL, &context);
#else
      SUNContext_Create(nullptr, &context);
#endif
      AssertThrow(context != nullptr, dealii::ExcOutOfMemory(0));
      return context;
    }



    const char *
    advice(const int code)
    {
      switch (code)
        {
          case ARK_TOO_MUCH_ACC:
            return "the tolerances are below the rounding of the viscous "
                   "strain. Raise [Time integration] Relative tolerance or "
                   "Absolute tolerance; under a mean load [Periodic state] "
                   "Secular split = on keeps the strain small";
          case ARK_TOO_MUCH_WORK:
            return "there are more than 1000000 steps from one sample to the "
                   "next. Raise [Time integration] Relative tolerance, or "
                   "choose Scheme = arkode implicit or sdirk2";
          case ARK_ERR_FAILURE:
            return "no step is short enough for the tolerances. Raise [Time "
                   "integration] Relative tolerance or Absolute tolerance "
                   "above the accuracy of the contact problems ([Contact] "
                   "Tolerance), look at what jumps in time at this instant, or "
                   "choose Step control = uniform";
          case ARK_CONV_FAILURE:
            return "an implicit stage was not solved. Choose Scheme = sdirk2";
          case ARK_RHSFUNC_FAIL:
          case ARK_FIRST_RHSFUNC_ERR:
          case ARK_REPTD_RHSFUNC_ERR:
          case ARK_UNREC_RHSFUNC_ERR:
          case ARK_RTFUNC_FAIL:
            return "a contact problem was not solved";
          default:
            return "this is an internal error. Choose Scheme = sdirk2 or heun, "
                   "and report it";
        }
    }
  } // namespace



  std::string
  describe_arkode_failure(const int          code,
                          const double       t,
                          const std::string &words)
  {
    std::ostringstream text;
    text << "ARKODE stopped at t = " << t << " (code " << code
         << "): " << advice(code) << '.';
    if (!words.empty())
      text << " In its own words: " << words;
    return text.str();
  }



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



  int
  ArkodeDriver::check(const int code)
  {
    if (thrown)
      std::rethrow_exception(std::exchange(thrown, nullptr));
    if (code < 0)
      throw NumericalError(describe_arkode_failure(code, current_time, words));
    return code;
  }



  ArkodeDriver::ArkodeDriver(const Settings    &settings,
                             const ArkodeTable &table,
                             CachedRate        &equation,
                             const double       t,
                             const Vector      &r)
    : settings(settings)
    , equation(equation)
    , context(make_context(),
              [](SUNContext pointer) { SUNContext_Free(&pointer); })
    , current_time(t)
    , current(r)
    , view(make_nvector_view(current, context.get()))
    , memory(ARKStepCreate(settings.is_implicit ? nullptr : &right_hand_side,
                           settings.is_implicit ? &right_hand_side : nullptr,
                           t,
                           view,
                           context.get()),
             [](void *pointer) { ARKStepFree(&pointer); })
  {
    AssertThrow(memory != nullptr, dealii::ExcOutOfMemory(0));
    collect_messages();
    check(ARKStepSetUserData(memory.get(), this));
    set_method(table);
    if (settings.tolerances.size() > 0)
      set_step_control();
  }



  void
  ArkodeDriver::collect_messages()
  {
#if DEAL_II_SUNDIALS_VERSION_GTE(7, 0, 0)
    // Errors; warnings, which are no reason to fail, go to SUNDIALS' own log.
    SUNContext_ClearErrHandlers(context.get());
    SUNContext_PushErrHandler(
      context.get(),
      [](int,
         const char *,
         const char *,
         const char *message,
         SUNErrCode,
         void *words,
         SUNContext) { *static_cast<std::string *>(words) = message; },
      &words);
#else
    ARKStepSetErrHandlerFn(
      memory.get(),
      [](int, const char *, const char *, char *message, void *words) {
        *static_cast<std::string *>(words) = message;
      },
      &words);
#endif
  }



  void
  ArkodeDriver::set_method(const ArkodeTable &table)
  {
    const ARKodeButcherTable tables = table.table();
    check(ARKStepSetTables(memory.get(),
                           tables->q,
                           tables->p,
                           settings.is_implicit ? tables : nullptr,
                           settings.is_implicit ? nullptr : tables));
    if (!settings.is_implicit)
      return;
    exact_stage = std::make_unique<ExactStage>(
      [this](
        const double t, const Vector &known, const double c, Vector &rate) {
        return guarded([&]() { equation.implicit_rate(t, known, c, rate); });
      },
      context.get());
    check(ARKStepSetNonlinearSolver(memory.get(), exact_stage->solver()));
    // An exact stage has told its rate.
    check(ARKStepSetDeduceImplicitRhs(memory.get(), 1));
  }



  void
  ArkodeDriver::set_step_control()
  {
    check(ARKStepSVtolerances(
      memory.get(), 0., make_nvector_view(settings.tolerances, context.get())));
    // What is constant for a while asks for steps that miss what comes after.
    check(ARKStepSetMaxStep(memory.get(), settings.longest_step));
    check(ARKStepSetMaxNumSteps(memory.get(),
                                TimeIntegrationParameters::most_steps));
    // A jump of the load is met by steps of the size of the tolerance.
    check(ARKStepSetMaxErrTestFails(memory.get(), 50));
    if (!settings.seeks_events)
      return;
    const int n = switching_functions().size();
    check(ARKStepRootInit(memory.get(), n, n > 0 ? &root_function : nullptr));
    check(ARKStepSetNoInactiveRootWarn(memory.get()));
  }



  std::vector<double>
  ArkodeDriver::switching_functions() const
  {
    std::vector<double> mine, all;
    equation.last().switching_functions(mine);
    for (const std::vector<double> &values :
         dealii::Utilities::MPI::all_gather(current.get_mpi_communicator(),
                                            mine))
      all.insert(all.end(), values.begin(), values.end());
    return all;
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
      Vector rate(self->current);
      self->equation.show(t, *unwrap_nvector_const<Vector>(y), rate);
      const std::vector<double> all = self->switching_functions();
      std::copy(all.begin(), all.end(), values);
    });
  }



  void
  ArkodeDriver::restart(const double t, const Vector &r, const bool is_new)
  {
    current      = r;
    current_time = t;
    check(ARKStepReset(memory.get(), t, view));
    if (is_new)
      check(ARKStepSetInitStep(memory.get(), 0.));
  }



  void
  ArkodeDriver::fixed_step(const double step)
  {
    const double end = current_time + step;
    check(ARKStepSetFixedStep(memory.get(), step));
    check(ARKStepSetStopTime(memory.get(), end));
    check(ARKStepEvolve(memory.get(), end, view, &current_time, ARK_ONE_STEP));
  }



  bool
  ArkodeDriver::evolve(const double end, const double stop)
  {
    check(ARKStepSetStopTime(memory.get(), stop));
    return check(ARKStepEvolve(
             memory.get(), end, view, &current_time, ARK_NORMAL)) ==
           ARK_ROOT_RETURN;
  }



  double
  ArkodeDriver::end_of_step() const
  {
    double t;
    ARKStepGetCurrentTime(memory.get(), &t);
    return t;
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
