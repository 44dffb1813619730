// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/collectively.h>
#include <crevasse/parameters/parameters.h>
#include <crevasse/time/arkode_driver.h>

#include <algorithm>
#include <arkode/arkode_arkstep.h>
#include <sstream>

namespace Crevasse
{
  using dealii::SUNDIALS::internal::make_nvector_view;
  using dealii::SUNDIALS::internal::unwrap_nvector;
  using dealii::SUNDIALS::internal::unwrap_nvector_const;

  namespace
  {
    /** Creates a context without communicator: vectors have one. */
    SUNContext
    make_context()
    {
      SUNContext context = nullptr;
#if DEAL_II_SUNDIALS_VERSION_GTE(7, 0, 0)
      SUNContext_Create(SUN_COMM_NULL, &context);
#else
      SUNContext_Create(nullptr, &context);
#endif
      return context;
    }
  } // namespace



  std::string
  describe_arkode_failure(const int          code,
                          const double       t,
                          const std::string &words)
  {
    std::ostringstream text;
    text << "ARKODE stopped at t = " << t << " (code " << code << "): ";
    if (code == ARK_TOO_MUCH_ACC)
      text << "the tolerances are below the rounding of the viscous strain. "
              "Raise [Time integration] Relative tolerance or Absolute "
              "tolerance; under a mean load [Periodic state] Secular split = "
              "on keeps the strain small.";
    else if (code == ARK_TOO_MUCH_WORK)
      text << "there are more than " << TimeIntegrationParameters::most_steps
           << " steps from one sample to the next. Raise [Time integration] "
              "Relative tolerance, or choose Scheme = arkode implicit or "
              "sdirk2.";
    else if (code == ARK_ERR_FAILURE)
      text << "no step is short enough for the tolerances. Raise [Time "
              "integration] Relative tolerance or Absolute tolerance above the "
              "accuracy of the contact problems ([Contact] Tolerance), check "
              "for a jump of loads or material at this instant, or choose Step "
              "control = uniform.";
    else
      text << "this is an internal error. Choose Scheme = sdirk2 or heun, and "
              "report it.";
    if (!words.empty())
      text << " Message of ARKODE: " << words;
    return text.str();
  }



  template <typename Evaluate>
  int
  ArkodeDriver::guarded(const Evaluate &evaluate)
  {
    try
      {
        evaluate();
        thrown = nullptr;
        return 0;
      }
    catch (const NumericalError &)
      {
        thrown = std::current_exception();
        return SUN_NLS_CONV_RECVR; // a shorter step may succeed
      }
    catch (...)
      {
        thrown = std::current_exception();
        return -1;
      }
  }



  int
  ArkodeDriver::check(const int code)
  {
    if (code >= 0)
      return code;
    if (thrown)
      std::rethrow_exception(std::exchange(thrown, nullptr));
    throw NumericalError(describe_arkode_failure(code, current_time, words));
  }



  ArkodeDriver::ArkodeDriver(const bool               is_implicit,
                             const ARKodeButcherTable table,
                             CachedRate              &equation,
                             const double             t,
                             const Vector            &r)
    : equation(equation)
    , context(make_context(),
              [](SUNContext pointer) { SUNContext_Free(&pointer); })
    , current_time(t)
    , current(r)
    , view(make_nvector_view(current, context.get()))
    , memory(ARKStepCreate(is_implicit ? nullptr : &right_hand_side,
                           is_implicit ? &right_hand_side : nullptr,
                           t,
                           view,
                           context.get()),
             [](void *pointer) { ARKStepFree(&pointer); })
    , solver(SUNNonlinSolNewEmpty(context.get()), &SUNNonlinSolFreeEmpty)
  {
    collect_messages();
    check(ARKStepSetUserData(memory.get(), this));
    check(ARKStepSetTables(memory.get(),
                           table->q,
                           table->p,
                           is_implicit ? table : nullptr,
                           is_implicit ? nullptr : table));
    if (is_implicit)
      solve_stages_exactly();
  }



  void
  ArkodeDriver::collect_messages()
  {
#if DEAL_II_SUNDIALS_VERSION_GTE(7, 0, 0)
    // Errors are caught; warnings go to SUNDIALS' own log.
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



  // Replaces ARKODE's nonlinear solver: the stages z = z_p + z_c of a
  // diagonally implicit method are the solutions of
  //
  //     z_c = d + γΔt f(z_p + z_c, t)
  //
  // with the known part d from earlier stages (SUNDIALS 6.4, ARKODE, "Nonlinear
  // solver methods"). That is r = r̂ + c f(r,t) with r̂ = z_p + d and c = γΔt:
  // RateEquation::implicit_rate solves it, once and exactly.
  void
  ArkodeDriver::solve_stages_exactly()
  {
    solver->content = this;
    // The type needs no linear solver of ARKODE's.
    solver->ops->gettype = [](SUNNonlinearSolver) {
      return SUNNONLINEARSOLVER_FIXEDPOINT;
    };
    // The stage system is known without ARKODE's function.
    solver->ops->setsysfn = [](SUNNonlinearSolver, SUNNonlinSolSysFn) {
      return 0;
    };
    solver->ops->solve = [](SUNNonlinearSolver self,
                            N_Vector,
                            N_Vector correction,
                            N_Vector,
                            sunrealtype,
                            sunbooleantype,
                            void *) {
      return static_cast<ArkodeDriver *>(self->content)
        ->solve_stage(correction);
    };
    check(ARKStepSetNonlinearSolver(memory.get(), solver.get()));
    // An exact stage already has its rate.
    check(ARKStepSetDeduceImplicitRhs(memory.get(), 1));
  }



  int
  ArkodeDriver::solve_stage(N_Vector correction)
  {
    double   t, c;
    N_Vector predicted, state, implicit_rate, data;
    void    *user_data;
    return guarded([&]() {
      check(ARKStepGetNonlinearSystemData(memory.get(),
                                          &t,
                                          &predicted,
                                          &state,
                                          &implicit_rate,
                                          &c,
                                          &data,
                                          &user_data));
      known = *unwrap_nvector_const<Vector>(predicted);
      known += *unwrap_nvector_const<Vector>(data);
      rate.reinit(known, true);
      equation.implicit_rate(t, known, c, rate);
      Vector &z_c = *unwrap_nvector<Vector>(correction);
      z_c         = *unwrap_nvector_const<Vector>(data);
      z_c.add(c, rate);
    });
  }



  void
  ArkodeDriver::control_steps(Vector tolerances)
  {
    check(ARKStepSVtolerances(memory.get(),
                              0.,
                              make_nvector_view(tolerances, context.get())));
    check(ARKStepSetMaxNumSteps(memory.get(),
                                TimeIntegrationParameters::most_steps));
    // A jump of the load is resolved by steps of the size of the tolerance.
    check(ARKStepSetMaxErrTestFails(memory.get(), 50));
    check(ARKStepSetMaxConvFails(memory.get(), 50));
  }



  void
  ArkodeDriver::limit_steps(const double stability_limit)
  {
    limit = stability_limit;
    check(ARKStepSetCFLFraction(memory.get(), 0.9));
    check(ARKStepSetStabilityFn(
      memory.get(),
      [](N_Vector, sunrealtype, sunrealtype *longest, void *user_data) {
        auto *self = static_cast<ArkodeDriver *>(user_data);
        return self->guarded([&]() {
          const double rate = self->equation.last().relaxation_rate();
          *longest          = rate > 0. ? self->limit / rate : 0.; // 0: none
        });
      },
      this));
  }



  void
  ArkodeDriver::seek_events()
  {
    const ARKRootFn functions =
      [](sunrealtype t, N_Vector y, sunrealtype *values, void *user_data) {
        auto *self = static_cast<ArkodeDriver *>(user_data);
        return self->guarded([&]() {
          self->rate.reinit(self->current, true);
          self->equation.show(t, *unwrap_nvector_const<Vector>(y), self->rate);
          const std::vector<double> all = self->switching_functions();
          std::copy(all.begin(), all.end(), values);
        });
      };
    const int n = switching_functions().size();
    check(ARKStepRootInit(memory.get(), n, n > 0 ? functions : nullptr));
    check(ARKStepSetNoInactiveRootWarn(memory.get()));
  }



  std::vector<double>
  ArkodeDriver::switching_functions() const
  {
    std::vector<std::vector<double>> mine; // one list: there is no friction
    equation.last().switching_functions(mine);
    return of_all_ranks(current.get_mpi_communicator(), mine.front());
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



  void
  ArkodeDriver::controlled_step(const double step)
  {
    check(ARKStepSetFixedStep(memory.get(), 0.));
    check(ARKStepReset(memory.get(), current_time, view));
    check(ARKStepSetInitStep(memory.get(), step));
    evolve(current_time + step);
  }



  bool
  ArkodeDriver::evolve(const double end)
  {
    check(ARKStepSetStopTime(memory.get(), end));
    return check(ARKStepEvolve(
             memory.get(), end, view, &current_time, ARK_NORMAL)) ==
           ARK_ROOT_RETURN;
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
