// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_parameters_solver_selections_h
#define crevasse_parameters_solver_selections_h

#include <crevasse/base/selection.h>

namespace Crevasse
{
  // Enums that a scene selects by name (see selections.h): methods of solution.

  enum class ContactSolverType
  {
    automatic,
    projected_sor,
    active_set,
    condensed_active_set
  };

  template <>
  struct Selection<ContactSolverType>
  {
    struct Row
    {
      ContactSolverType value;
      const char       *name;
      bool              relaxes;           ///< needs the entries of the matrix
      bool              stops_early;       ///< uses [Linear solver] Tolerance
      bool              counts_iterations; ///< uses Maximum iterations
    };
    static constexpr Row rows[] = {
      {ContactSolverType::automatic, "automatic", false, true, true},
      {ContactSolverType::projected_sor, "projected sor", true, false, true},
      {ContactSolverType::active_set, "active set", false, true, true},
      {ContactSolverType::condensed_active_set,
       "condensed active set",
       false,
       false,
       false}};
    static constexpr const char *meaning =
      "Solver of the contact problems: \"condensed active set\" eliminates all "
      "unknowns but those of the lip, \"active set\" iterates on all unknowns, "
      "\"projected sor\" is the method of Raous (1980), for one process. "
      "\"automatic\": \"condensed active set\", or \"active set\" for very "
      "large lips or meshes.";
  };

  enum class LinearSolverType
  {
    automatic,
    cholesky,
    mumps,
    amg,
    gmg
  };

  template <>
  struct Selection<LinearSolverType>
  {
    struct Row
    {
      LinearSolverType value;
      const char      *name;
      bool             is_direct;
      bool             is_multigrid;
    };
    static constexpr Row rows[] = {
      {LinearSolverType::automatic, "automatic", false, false},
      {LinearSolverType::cholesky, "cholesky", true, false},
      {LinearSolverType::mumps, "mumps", true, false},
      {LinearSolverType::amg, "amg", false, true},
      {LinearSolverType::gmg, "gmg", false, true}};
    static constexpr const char *meaning =
      "Solver of the linear systems: factorisation by CHOLMOD on one process "
      "(\"cholesky\") or by MUMPS on several, or conjugate gradients with "
      "algebraic multigrid (ML, \"amg\") or matrix-free geometric multigrid "
      "(\"gmg\"). \"automatic\" depends on dimension, size and number of "
      "processes.";
  };

  enum class Scheme
  {
    euler,
    heun,
    rk4,
    predictor_corrector,
    exponential,
    sdirk2,
    trapezoid,
    arkode_explicit,
    arkode_implicit,
    automatic
  };

  template <>
  struct Selection<Scheme>
  {
    struct Row
    {
      Scheme      value;
      const char *name;
      bool        estimates_error;    ///< estimates errors of steps
      bool        keeps_matrices;     ///< own matrices of instants
      bool        flows_by_mean_load; ///< flows as the secular problem
      bool        is_of_arkode;
    };
    static constexpr Row rows[] = {
      {Scheme::euler, "euler", false, false, true, false},
      {Scheme::heun, "heun", true, false, true, false},
      {Scheme::rk4, "rk4", false, false, true, false},
      {Scheme::predictor_corrector,
       "predictor corrector",
       false,
       true,
       false,
       false},
      {Scheme::exponential, "exponential", true, true, false, false},
      {Scheme::sdirk2, "sdirk2", true, true, true, false},
      {Scheme::trapezoid, "trapezoid", false, true, true, false},
      {Scheme::arkode_explicit, "arkode explicit", true, false, true, true},
      {Scheme::arkode_implicit, "arkode implicit", true, true, true, true},
      {Scheme::automatic, "automatic", true, true, true, false}};
    static constexpr const char *meaning =
      "Method for the viscous strain. Explicit, with a limit of the step: "
      "\"euler\", \"heun\" and \"rk4\" of order 1, 2 and 4, and \"predictor "
      "corrector\" of order 2, implicit in the material alone. Without limit: "
      "\"exponential\" of order 2, exact where the strain is held, \"sdirk2\" "
      "of order 2, implicit, and \"trapezoid\" of order 2, implicit, in which "
      "fast components oscillate instead of decaying: it is refused for creep "
      "by a power law. \"arkode explicit\" and \"arkode implicit\" are "
      "methods of the library ARKODE, of the Order given. \"automatic\" is "
      "\"trapezoid\" where all instants are solved for "
      "at once (see Periodic state/Method), otherwise \"sdirk2\".";
  };

  /** Method to choose the instants at which time steps end. */
  enum class StepControlType
  {
    uniform,
    list,
    adaptive
  };

  template <>
  struct Selection<StepControlType>
  {
    static constexpr NamedValue<StepControlType> rows[] = {
      {StepControlType::uniform, "uniform"},
      {StepControlType::list, "list"},
      {StepControlType::adaptive, "adaptive"}};
    static constexpr const char *meaning =
      "Choice of the time steps: \"uniform\" are equal steps, \"list\" are "
      "steps between the instants of Steps, \"adaptive\" are steps from an "
      "error estimate, for the schemes heun, exponential, sdirk2, arkode "
      "explicit and arkode implicit.";
  };

  enum class PeriodicMethodType
  {
    march,
    anderson,
    fourier,
    automatic
  };

  template <>
  struct Selection<PeriodicMethodType>
  {
    static constexpr NamedValue<PeriodicMethodType> rows[] = {
      {PeriodicMethodType::march, "march"},
      {PeriodicMethodType::anderson, "anderson"},
      {PeriodicMethodType::fourier, "fourier"},
      {PeriodicMethodType::automatic, "automatic"}};
    static constexpr const char *meaning =
      "Method for the periodic state. \"march\" follows the motion of the "
      "body, period after period, until the stress repeats; \"anderson\" "
      "starts each period from the combination of earlier ones that is closest "
      "to periodic; \"fourier\" is harmonic balance: all instants at once, if "
      "only the loads depend on time and the steps are equal. \"automatic\": "
      "the fastest method that the scene allows, and another one if it fails.";
  };

  enum class StartFrom
  {
    rest,
    fourier
  };

  template <>
  struct Selection<StartFrom>
  {
    static constexpr NamedValue<StartFrom> rows[] = {{StartFrom::rest, "rest"},
                                                     {StartFrom::fourier,
                                                      "fourier"}};
    static constexpr const char           *meaning =
      "Initial viscous strain of \"march\" and \"anderson\": \"rest\" is zero, "
      "\"fourier\" is the result of harmonic balance.";
  };

  enum class SecularSplitType
  {
    automatic,
    on,
    off
  };

  template <>
  struct Selection<SecularSplitType>
  {
    static constexpr NamedValue<SecularSplitType> rows[] = {
      {SecularSplitType::automatic, "automatic"},
      {SecularSplitType::on, "on"},
      {SecularSplitType::off, "off"}};
    static constexpr const char *meaning =
      "Treatment of the secular flow beta t that a mean load causes in u = "
      "beta t + q, with a periodic q. \"automatic\": a stationary contact "
      "problem gives beta, if there is a mean load and the viscosity is a "
      "function of space times one of time; the run integrates u from rest. "
      "\"on\": the run integrates only q, with its own contact condition, "
      "towards the same periodic state. \"off\": the run only measures the "
      "gain of displacement over a period.";
  };

  enum class HarmonicRule
  {
    trapezoid,
    exact
  };

  template <>
  struct Selection<HarmonicRule>
  {
    static constexpr NamedValue<HarmonicRule> rows[] =
      {{HarmonicRule::trapezoid, "trapezoid"}, {HarmonicRule::exact, "exact"}};
    static constexpr const char *meaning =
      "Time integration of each harmonic by \"fourier\": \"trapezoid\" is the "
      "trapezoidal rule, as with Scheme = trapezoid; \"exact\" is analytical.";
  };
} // namespace Crevasse

#endif
