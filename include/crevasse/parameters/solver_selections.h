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
      "Method for the contact inequality. \"condensed active set\" reduces it "
      "to the lip, \"active set\" works on all unknowns, \"projected sor\" is "
      "the method of the paper, for one process; \"automatic\" takes the "
      "condensed one, or \"active set\" if the lip or "
      "the mesh is very large.";
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
      "or by MUMPS on several, or conjugate gradients with algebraic multigrid "
      "(ML) or matrix-free geometric multigrid. \"automatic\" chooses "
      "by dimension, size and number of processes.";
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
      bool        estimates_error;    ///< for adaptive steps
      bool        keeps_matrices;     ///< own matrices of instants
      bool        flows_by_mean_load; ///< as the secular problem
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
      "Where the steps end: \"uniform\" divides the period equally, \"list\" "
      "takes the instants of Steps, \"adaptive\" chooses steps by their error, "
      "with schemes that estimate it: heun, exponential, sdirk2 and those of "
      "arkode.";
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
      "How the periodic state is found. \"march\" computes one period after "
      "the other until the stress repeats, as the body itself would; "
      "\"anderson\" starts each from the combination of the last ones that "
      "comes closest to repeating; \"fourier\" solves for all instants at "
      "once, where nothing but the loads depends on time and the steps are "
      "equal; \"automatic\" takes the fastest that the scene allows, and "
      "another one where that fails.";
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
      "Viscous strain with which \"march\" and \"anderson\" begin: \"rest\" is "
      "none, \"fourier\" that of harmonic balance.";
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
      "The flow beta that a mean load causes is the solution of a stationary "
      "contact problem. \"automatic\" finds it so if there is a mean load and "
      "the viscosity is a function of place times one of time, and integrates "
      "the whole motion from rest; \"on\" integrates only the periodic part "
      "q of u = beta t + q, which has a contact condition of its own: the "
      "periodic state is the same, the way to it is not; \"off\" only "
      "measures what the displacement gains over a period.";
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
      "How \"fourier\" integrates each harmonic over the steps: \"trapezoid\" "
      "by the trapezoidal rule, as the scheme of that name would; \"exact\" "
      "each "
      "harmonic exactly.";
  };
} // namespace Crevasse

#endif
