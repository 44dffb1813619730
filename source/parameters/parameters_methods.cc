// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/parameters/parameters.h>

namespace Crevasse
{
  using namespace dealii;

  namespace
  {
    using Patterns::Integer;
    using Patterns::List;

    const NumberPattern not_negative(Ranges::not_negative);
    const NumberPattern fraction(Ranges::fraction);

    NumberPattern
    number_up_to(const double most, const char *words)
    {
      return NumberPattern({Ranges::above_0, most, words});
    }
  } // namespace



  void
  DiscretisationParameters::add_parameters(ParameterHandler &prm)
  {
    prm.add_parameter("Degree",
                      degree,
                      "Polynomial degree of the finite elements.",
                      Integer(1, 2));
    add_selection("Volumetric strain", volumetric_strain, prm);
    add_selection("Singular functions", singular_functions, prm);
  }



  void
  RefinementParameters::add_parameters(ParameterHandler &prm)
  {
    add_selection("Strategy", strategy, prm);
    prm.add_parameter(
      "Target unknowns",
      target_unknowns,
      "Number of unknowns that refinement does not exceed; 0: no limit.",
      Integer(0));
    prm.add_parameter(
      "Cycles",
      cycles,
      "Number of refinement cycles; each adaptive cycle estimates the error "
      "and divides cells once. 0: until Target unknowns or Tolerance is "
      "reached; an adaptive cycle then divides cells several times.",
      Integer(0));
    add_selection("Marking", marking, prm);
    prm.add_parameter("Refine fraction",
                      refine_fraction,
                      "Fraction of the error or of the cells (see Marking) "
                      "that is refined, largest errors first.",
                      NumberPattern(
                        {Ranges::above_0, 1., "greater than 0, at most 1"}));
    prm.add_parameter("Coarsen fraction",
                      coarsen_fraction,
                      "Fraction of the error or of the cells (see Marking) "
                      "that is coarsened, smallest errors first.",
                      fraction);
    prm.add_parameter(
      "Tolerance",
      tolerance,
      "Estimated error of the stress, relative to the stress, in the energy "
      "norm, at which adaptive refinement ends; 0: no tolerance.",
      fraction);
    prm.add_parameter(
      "Instants",
      instants,
      "Instants within the period at which the error is estimated, in units of "
      "time; each cell takes its largest error. Empty: the instant of the "
      "largest load, and of the largest opposite load, if any. Allowed: "
      "numbers from 0 to the period, separated by commas",
      List(not_negative));
    prm.add_parameter(
      "Readapt every",
      readapt_every,
      "Number of periods after which the mesh is adapted again, to the stress "
      "of the last period. 0: only before the run.",
      Integer(0));
  }



  void
  ContactParameters::add_parameters(ParameterHandler &prm)
  {
    add_selection("Solver", solver, prm);
    relaxation_factor.add_parameter(
      "Relaxation factor",
      "Relaxation factor of projected SOR. \"automatic\": the program searches "
      "for the best one. Allowed: automatic, or a number greater than 0 and "
      "less than 2",
      prm);
    prm.add_parameter(
      "Tolerance",
      tolerance,
      "Largest error that the certificate of a contact problem may show: "
      "penetration and complementarity relative to the largest displacement, "
      "tension and residual relative to the largest nodal force of the loads. "
      "Where rounding errors are larger, their size is the tolerance.",
      number_up_to(1e-2, "greater than 0, at most 0.01"));
    prm.add_parameter("Maximum iterations",
                      maximum_iterations,
                      "Largest number of iterations of the solvers \"projected "
                      "sor\" (sweeps) and \"active set\" (active sets).",
                      Integer(1));
    prm.add_parameter(
      "Relaxation table",
      relaxation_table,
      "Relaxation factors for a table of SOR iterations; empty: no table.",
      List(NumberPattern(relaxation_factors)));
  }



  void
  LinearSolverParameters::add_parameters(ParameterHandler &prm)
  {
    add_selection("Type", type, prm);
    prm.add_parameter("Tolerance",
                      tolerance,
                      "Factor by which conjugate gradients reduce the residual "
                      "before the solver \"active set\" updates its set; "
                      "[Contact] Tolerance bounds the error of the result.",
                      number_up_to(0.1, "greater than 0, at most 0.1"));
    prm.add_parameter(
      "Memory for instants",
      memory_for_instants,
      "Memory in MiB for matrices, factors and material data of different "
      "instants of the period, if they vary in time by more than a factor. "
      "Data of instants that do not fit are computed again in each period.",
      not_negative);
  }



  void
  TimeIntegrationParameters::add_parameters(ParameterHandler &prm)
  {
    add_selection("Scheme", scheme, prm);
    prm.add_parameter("Heun weight",
                      heun_weight,
                      "Weight w of the second stage of \"heun\"; the stage "
                      "lies at the fraction 1/(2w) of the step.",
                      NumberPattern({0.5, 1., "from 0.5 to 1"}));
    prm.add_parameter(
      "Steps per period",
      steps_per_period,
      "Number of steps per period with Step control = uniform. With adaptive "
      "steps: number of the longest steps, which shorter ones divide.",
      Integer(1, most_steps));
    add_selection("Step control", step_control, prm);
    prm.add_parameter(
      "Steps",
      steps,
      "Instants at which steps end, in units of time: all of them with Step "
      "control = list; with adaptive steps additional ones, such as the "
      "instant at which a load jumps. Allowed: increasing numbers from 0 to "
      "the period, separated by commas",
      List(not_negative));
    prm.add_parameter("Relative tolerance",
                      relative_tolerance,
                      "Target error of the stress with adaptive steps, "
                      "relative to the largest elastic stress of the period; "
                      "both are root mean squares over the volume.",
                      fraction);
    prm.add_parameter("Absolute tolerance",
                      absolute_tolerance,
                      "Target error of the stress with adaptive steps, in "
                      "units of stress, in addition to Relative tolerance.",
                      not_negative);
    prm.add_parameter(
      "Newton tolerance",
      newton_tolerance,
      "Largest residual of equilibrium in implicit stages of nonlinear creep, "
      "relative to the largest nodal force of the loads.",
      NumberPattern({1e-13, Ranges::below_1, "at least 1e-13, less than 1"}));
    prm.add_parameter("Order",
                      order,
                      "Order of the schemes \"arkode explicit\" and \"arkode "
                      "implicit\".",
                      Integer(2, 5));
    prm.add_parameter("Locate contact events",
                      locate_contact_events,
                      "Whether steps are divided where nodes of the crack lip "
                      "open, close or, with friction, begin to slide. "
                      "Otherwise the kinks of the solution there limit every "
                      "scheme to order 2, with friction to order 1.");
    prm.add_parameter(
      "Check stability",
      check_stability,
      "Whether steps beyond the stability limit of the scheme are refused. "
      "Otherwise the stress grows from step to step.");
  }



  void
  PeriodicStateParameters::add_parameters(ParameterHandler &prm)
  {
    add_selection("Method", method, prm);
    add_selection("Secular split", secular_split, prm);
    prm.add_parameter("Maximum periods",
                      maximum_periods,
                      "Largest number of periods; the search ends there even "
                      "if the stress is not periodic.",
                      Integer(0));
    prm.add_parameter(
      "Tolerance",
      tolerance,
      "Estimated error of the stress, relative to the largest stress, at which "
      "the state counts as periodic. 0: the run computes Maximum periods.",
      fraction);
    prm.add_parameter("Anderson depth",
                      anderson_depth,
                      "Number of earlier periods that \"anderson\" and "
                      "\"averaged\" combine with the last one; 0: none.",
                      Integer(0));
    prm.add_parameter("Averaged poles",
                      averaged_poles,
                      "Number of terms with which \"averaged\" imitates how "
                      "stress relaxes within a period: 2 needs fewer periods, "
                      "1 less memory.",
                      Integer(1, 2));
    add_selection("Harmonics", harmonics, prm);
    prm.add_parameter(
      "Converged quantity",
      converged_quantity,
      "What Tolerance is for: \"stress\" at all points, \"K_I\" of all tips, "
      "the largest \"opening\" of the lip, or the stress at a \"probe NAME\"; "
      "relative to its largest value in the period.");
    prm.add_parameter(
      "Missions",
      missions,
      "Numbers of periods of the motion from rest, increasing, as in \"10, "
      "100, 1000\": these periods are computed instead of the periodic state, "
      "each with a row in missions.csv. Periods between them are leapt over.",
      List(Integer(1), 0, List::max_int_value));
    prm.add_parameter("Mission tolerance",
                      mission_tolerance,
                      "Largest difference, relative to the largest stress, of "
                      "a leap over periods and of two leaps over half of them, "
                      "which are extrapolated.",
                      NumberPattern(
                        {1e-6, Ranges::below_1, "at least 1e-6, less than 1"}));
  }



  void
  CrackTipParameters::add_parameters(ParameterHandler &prm)
  {
    add_selection("Stress intensity", stress_intensity, prm);
    prm.add_parameter(
      "Creep integral",
      creep_integral,
      "Whether to write the integral C(t) at each step to creep_integral.csv, "
      "or to creep_integral_1.csv, creep_integral_2.csv, ... for each tip of "
      "cracks with two lips; in three dimensions at the vertices of the front "
      "to crack_front.csv. Needs nonlinear creep without hardening. In steady "
      "creep C(t) is C*.");
    add_selection("Method", method, prm);
    prm.add_parameter(
      "Radius",
      radius,
      "Size of the region around the crack tip that gives K_I or C(t), in "
      "units of length; 0: automatic. For integrals: largest half side of the "
      "square, which is reduced until it cuts no cell; in three dimensions "
      "half side of the square across the front. For the fit: radius of the "
      "larger disc.",
      not_negative);
    add_selection("Crack growth law", growth_law, prm);
    add_selection("Growth range", growth_range, prm);
    const std::string formula  = " or a formula of theta with such values";
    const std::string not_less = " Allowed: a number of at least 0" + formula;
    const std::string positive = " Allowed: a number greater than 0" + formula;
    const std::string used =
      " Allowed: a number greater than 0 where it is used" + formula;
    paris_factor.add_parameter(
      "Paris factor",
      "Factor C of the laws of Paris and Walker: growth per period at dK - "
      "dK_th = 1, in units of length / (stress sqrt(length))^m. theta is the "
      "temperature at the tip." +
        used,
      prm);
    paris_exponent.add_parameter("Paris exponent",
                                 "Exponent m of the laws of Paris and Walker." +
                                   positive,
                                 prm);
    paris_threshold.add_parameter(
      "Paris threshold",
      "Threshold dK_th of the laws of Paris and Walker, in "
      "units of stress sqrt(length); below it the crack does "
      "not grow." +
        not_less,
      prm);
    walker_exponent.add_parameter(
      "Walker exponent",
      "Exponent w in the factor f_R = (1 - R)^(-(1 - w) m) of "
      "Walker's law; with 1 R has no influence." +
        not_less,
      prm);
    threshold_exponent.add_parameter(
      "Threshold exponent",
      "Number e in the factor f_th = 1 - exp(e (1 - "
      "dK/dK_th)) of Walker's law; 0: f_th is 1 above the "
      "threshold." +
        not_less,
      prm);
    toughness.add_parameter(
      "Fracture toughness",
      "Intensity K_c at which the crack runs through, in units "
      "of stress sqrt(length); 0: none." +
        not_less,
      prm);
    toughness_exponent.add_parameter(
      "Toughness exponent",
      "Number d in the factor f_c = 1 - exp(d (K_max/K_c - 1)) "
      "of Walker's law; 0: f_c is Forman's 1 - K_max/K_c." +
        not_less,
      prm);
    prm.add_parameter("Growth table",
                      growth_table,
                      "CSV file with the columns Delta_K, R and da_dN of "
                      "measured growth, next to the scene file or in the "
                      "working directory.");
    add_selection("Creep growth parameter", creep_parameter, prm);
    creep_factor.add_parameter(
      "Creep factor",
      "Factor D of growth by creep: speed at P = 1, in units of length / time "
      "/ P^phi. The unit of C* and C(t) is stress length / time, that of K_I "
      "is stress sqrt(length)." +
        used,
      prm);
    creep_exponent.add_parameter("Creep exponent",
                                 "Exponent phi of growth by creep." + positive,
                                 prm);
  }



  void
  OutputParameters::add_parameters(ParameterHandler &prm)
  {
    probes.add_parameter(
      "Probes",
      "Points whose displacement and stress are recorded at every step, each "
      "in a file probe_NAME.csv; coordinates are in units of length. "
      "\"automatic\": the mouth of a built-in crack. Allowed: automatic, or a "
      "list such as tip: 0.5, 0; corner: 1, 1, with as many coordinates as "
      "dimensions",
      prm);
    field_times.add_parameter(
      "Field times",
      "Instants of the last period at which fields are written, in units of "
      "time, in addition to the end of the run. \"automatic\": the instants of "
      "the largest opening, of the largest contact force, and of the largest "
      "and smallest stress intensity (without K in the plane: of the largest "
      "stress). Allowed: automatic, all, a number of equally spaced instants "
      "such as 12 instants, or numbers from 0 to the period, separated by "
      "commas",
      prm);
    add_selection("Fields", fields, prm);
    add_selection("Elastic comparison", elastic_comparison, prm);
    prm.add_parameter(
      "Load work",
      load_work,
      "Whether load_work.csv has the work of the loads at every step, for "
      "convergence studies in the energy norm.");
    prm.add_parameter(
      "Checkpoint every",
      checkpoint_every,
      "Number of periods between checkpoints, from which --resume continues; "
      "the run writes another one at its end. 0: a checkpoint is written only "
      "on a request to stop, on SIGUSR1, and at the end of a run that is not "
      "periodic.",
      Integer(0));
    prm.add_parameter(
      "Error bars",
      error_bars,
      "Whether results get error bars from the mesh, the steps "
      "and the search for the periodic state, by companion runs "
      "with larger cells and shorter steps.");
  }
} // namespace Crevasse
