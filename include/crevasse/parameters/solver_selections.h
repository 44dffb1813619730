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

  namespace Trait
  {
    enum OfContactSolver : unsigned int
    {
      relaxes           = 1, ///< needs the entries of the matrix
      stops_early       = 2, ///< uses [Linear solver] Tolerance
      counts_iterations = 4  ///< uses Maximum iterations
    };
  }

  template <>
  struct Selection<ContactSolverType>
  {
    using Row = ValueWithTraits<ContactSolverType, Trait::OfContactSolver>;
    static constexpr Row rows[] = {
      {ContactSolverType::automatic,
       "automatic",
       Trait::stops_early | Trait::counts_iterations},
      {ContactSolverType::projected_sor,
       "projected sor",
       Trait::relaxes | Trait::counts_iterations},
      {ContactSolverType::active_set,
       "active set",
       Trait::stops_early | Trait::counts_iterations},
      {ContactSolverType::condensed_active_set, "condensed active set", 0}};
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

  namespace Trait
  {
    enum OfLinearSolver : unsigned int
    {
      is_direct    = 1,
      is_multigrid = 2
    };
  }

  template <>
  struct Selection<LinearSolverType>
  {
    using Row = ValueWithTraits<LinearSolverType, Trait::OfLinearSolver>;
    static constexpr Row rows[] = {
      {LinearSolverType::automatic, "automatic", 0},
      {LinearSolverType::cholesky, "cholesky", Trait::is_direct},
      {LinearSolverType::mumps, "mumps", Trait::is_direct},
      {LinearSolverType::amg, "amg", Trait::is_multigrid},
      {LinearSolverType::gmg, "gmg", Trait::is_multigrid}};
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

  namespace Trait
  {
    enum OfScheme : unsigned int
    {
      estimates_error    = 1, ///< estimates errors of steps
      keeps_matrices     = 2, ///< own matrices of instants
      flows_by_mean_load = 4, ///< flows as the secular problem
      is_of_arkode       = 8
    };
  }

  template <>
  struct Selection<Scheme>
  {
    using Row                   = ValueWithTraits<Scheme, Trait::OfScheme>;
    static constexpr Row rows[] = {
      {Scheme::euler, "euler", Trait::flows_by_mean_load},
      {Scheme::heun,
       "heun",
       Trait::estimates_error | Trait::flows_by_mean_load},
      {Scheme::rk4, "rk4", Trait::flows_by_mean_load},
      {Scheme::predictor_corrector,
       "predictor corrector",
       Trait::keeps_matrices},
      {Scheme::exponential,
       "exponential",
       Trait::estimates_error | Trait::keeps_matrices},
      {Scheme::sdirk2,
       "sdirk2",
       Trait::estimates_error | Trait::keeps_matrices |
         Trait::flows_by_mean_load},
      {Scheme::trapezoid,
       "trapezoid",
       Trait::keeps_matrices | Trait::flows_by_mean_load},
      {Scheme::arkode_explicit,
       "arkode explicit",
       Trait::estimates_error | Trait::flows_by_mean_load |
         Trait::is_of_arkode},
      {Scheme::arkode_implicit,
       "arkode implicit",
       Trait::estimates_error | Trait::keeps_matrices |
         Trait::flows_by_mean_load | Trait::is_of_arkode},
      {Scheme::automatic,
       "automatic",
       Trait::estimates_error | Trait::keeps_matrices |
         Trait::flows_by_mean_load}};
    static constexpr const char *meaning =
      "Method for the viscous strain. Explicit, with a limit of the step: "
      "\"euler\", \"heun\" and \"rk4\" of order 1, 2 and 4, and \"predictor "
      "corrector\" of order 2, implicit in the material alone. Without limit: "
      "\"exponential\" of order 2, exact where the strain is held, \"sdirk2\" "
      "of order 2, implicit, and \"trapezoid\" of order 2, implicit, in which "
      "fast components oscillate instead of decaying: it is refused for "
      "nonlinear creep. \"arkode explicit\" and \"arkode implicit\" are "
      "methods of the library ARKODE, of the Order given. \"automatic\" is "
      "\"trapezoid\" where all instants are solved for "
      "at once (see Periodic state/Method), otherwise \"sdirk2\"; with "
      "friction and linear "
      "creep \"exponential\", with located contact events.";
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
    averaged,
    fourier,
    automatic
  };

  template <>
  struct Selection<PeriodicMethodType>
  {
    static constexpr NamedValue<PeriodicMethodType> rows[] = {
      {PeriodicMethodType::march, "march"},
      {PeriodicMethodType::anderson, "anderson"},
      {PeriodicMethodType::averaged, "averaged"},
      {PeriodicMethodType::fourier, "fourier"},
      {PeriodicMethodType::automatic, "automatic"}};
    static constexpr const char *meaning =
      "Method for the periodic state. \"march\" follows the motion of the "
      "body, period after period, until the stress repeats; \"anderson\" "
      "starts each period from the combination of earlier ones that is closest "
      "to periodic; \"averaged\" corrects each period by the flow of a body "
      "with the mean fluidity of the period, for relaxation times that lie "
      "decades apart; \"fourier\" is harmonic balance: all instants at once, "
      "if "
      "only the loads depend on time and the steps are equal. \"automatic\": "
      "the fastest method that the scene allows, and another one if it fails.";
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
