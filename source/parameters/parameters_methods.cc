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
    prm.add_parameter("Target unknowns",
                      target_unknowns,
                      "Refinement ends before the mesh has more unknowns; 0: "
                      "no limit.",
                      Integer(0));
    prm.add_parameter(
      "Cycles",
      cycles,
      "How often cells are divided, with adaptive once after each estimate; 0: "
      "until Target unknowns or Tolerance, several times after an estimate.",
      Integer(0));
    add_selection("Marking", marking, prm);
    prm.add_parameter("Refine fraction",
                      refine_fraction,
                      "The cells of the largest errors with this part of the "
                      "whole are divided.",
                      NumberPattern(
                        {Ranges::above_0, 1., "greater than 0, at most 1"}));
    prm.add_parameter("Coarsen fraction",
                      coarsen_fraction,
                      "The cells of the smallest errors with this part of the "
                      "whole are joined.",
                      fraction);
    prm.add_parameter(
      "Tolerance",
      tolerance,
      "Estimated error of the stress, relative to the stress (both in the "
      "energy norm), at which adaptive refinement ends; 0: none.",
      fraction);
    prm.add_parameter(
      "Instants",
      instants,
      "Instants within the period whose errors count, the largest of each "
      "cell; nothing: that of the largest load and that of the most opposite "
      "one, if there is an opposite one. In units of time. Allowed: numbers "
      "from 0 to the period, separated by commas",
      List(not_negative));
    prm.add_parameter(
      "Readapt every",
      readapt_every,
      "Number of periods after which the mesh is adapted anew to the stress "
      "of the last of them; 0: never.",
      Integer(0));
  }



  void
  ContactParameters::add_parameters(ParameterHandler &prm)
  {
    add_selection("Solver", solver, prm);
    relaxation_factor.add_parameter(
      "Relaxation factor",
      "Over-relaxation factor of the projected SOR method; \"automatic\" "
      "searches for the best one. Allowed: automatic, or a number greater than "
      "0 and less than 2",
      prm);
    prm.add_parameter("Tolerance",
                      tolerance,
                      "Largest error that the certificate of a solution may "
                      "show: penetration and complementarity relative to the "
                      "largest displacement, tension and residual relative to "
                      "the largest nodal force of the loads. Where rounding "
                      "does not allow so much, what it does allow counts.",
                      number_up_to(1e-2, "greater than 0, at most 0.01"));
    prm.add_parameter("Maximum iterations",
                      maximum_iterations,
                      "Iterations after which the solvers \"projected sor\" "
                      "(sweeps) and \"active set\" (sets) give up.",
                      Integer(1));
    prm.add_parameter("Relaxation table",
                      relaxation_table,
                      "Relaxation factors for which the iterations are counted "
                      "and tabulated; nothing: no table.",
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
    prm.add_parameter("Memory for instants",
                      memory_for_instants,
                      "Memory in MiB for matrices, factors and material data "
                      "that vary in time (not by a factor only): those of as "
                      "many instants of the period as it holds are kept, for "
                      "the others they are made anew in each period.",
                      not_negative);
  }



  void
  TimeIntegrationParameters::add_parameters(ParameterHandler &prm)
  {
    add_selection("Scheme", scheme, prm);
    prm.add_parameter("Heun weight",
                      heun_weight,
                      "Weight w of the second stage of the scheme \"heun\", "
                      "which lies at the fraction 1/(2w) of the step.",
                      NumberPattern({0.5, 1., "from 0.5 to 1"}));
    prm.add_parameter("Steps per period",
                      steps_per_period,
                      "Number of equal steps of the step control \"uniform\"; "
                      "with \"adaptive\" that of the longest steps; shorter "
                      "steps divide these, so that none misses their ends.",
                      Integer(1, most_steps));
    add_selection("Step control", step_control, prm);
    prm.add_parameter("Steps",
                      steps,
                      "Instants of the step control \"list\", in units of "
                      "time; with \"adaptive\" those at which a step ends in "
                      "any case, as where a load jumps. Allowed: increasing "
                      "numbers from 0 to the period, separated by commas",
                      List(not_negative));
    prm.add_parameter("Relative tolerance",
                      relative_tolerance,
                      "Error of the stress that the step control \"adaptive\" "
                      "aims at, relative to the largest elastic stress of the "
                      "period; both in the root mean square over the volume.",
                      fraction);
    prm.add_parameter("Absolute tolerance",
                      absolute_tolerance,
                      "The same in units of stress; both are added.",
                      not_negative);
    prm.add_parameter(
      "Newton tolerance",
      newton_tolerance,
      "Where creep by a power law is implicit: largest residual "
      "of equilibrium, relative to the largest nodal force of "
      "the loads.",
      NumberPattern({1e-13, Ranges::below_1, "at least 1e-13, less than 1"}));
    prm.add_parameter("Order",
                      order,
                      "Order of the schemes \"arkode explicit\" and \"arkode "
                      "implicit\".",
                      Integer(2, 5));
    prm.add_parameter("Locate contact events",
                      locate_contact_events,
                      "Whether steps are divided where nodes of the crack lip "
                      "open or close. Without that the kinks of the solution "
                      "limit every scheme to order 2.");
    prm.add_parameter("Check stability",
                      check_stability,
                      "Whether steps that are too long for a scheme with a "
                      "limit are refused. Without that they are taken, and the "
                      "stress grows from step to step.");
  }



  void
  PeriodicStateParameters::add_parameters(ParameterHandler &prm)
  {
    add_selection("Method", method, prm);
    add_selection("Start from", start_from, prm);
    add_selection("Secular split", secular_split, prm);
    prm.add_parameter("Maximum periods",
                      maximum_periods,
                      "Number of periods after which the search ends even if "
                      "the stress is not periodic.",
                      Integer(0));
    prm.add_parameter("Tolerance",
                      tolerance,
                      "Estimated error of the stress, relative to the largest "
                      "stress, at which the state counts as periodic; 0 "
                      "computes Maximum periods in any case.",
                      fraction);
    prm.add_parameter("Anderson depth",
                      anderson_depth,
                      "Number of earlier periods that \"anderson\" combines "
                      "with the last one.",
                      Integer(1));
    prm.add_parameter("Anderson damping",
                      anderson_damping,
                      "Part of what the combination still misses that is added "
                      "to it.",
                      number_up_to(1., "greater than 0, at most 1"));
    prm.add_parameter("Anderson delay",
                      anderson_delay,
                      "Periods that are marched before the first combination.",
                      Integer(0));
    add_selection("Harmonics", harmonics, prm);
  }



  void
  CrackTipParameters::add_parameters(ParameterHandler &prm)
  {
    add_selection("Stress intensity", stress_intensity, prm);
    prm.add_parameter(
      "Creep integral",
      creep_integral,
      "Whether creep_integral.csv has the integral C(t) of each "
      "step, with Viscosity = power law in the plane, or "
      "creep_integral_1.csv, creep_integral_2.csv, ... those of "
      "each tip of cracks with two lips. In steady creep it is "
      "C*.");
    add_selection("Method", method, prm);
    prm.add_parameter(
      "Radius",
      radius,
      "Half the side of that square at most, so that it cuts no "
      "cell, or the larger radius of the fit where that gives "
      "K_I, in units of length; in space, half the side of the square "
      "across the front; 0: automatic.",
      not_negative);
    add_selection("Crack growth law", growth_law, prm);
    prm.add_parameter("Paris factor",
                      paris_factor,
                      "C, the growth of a period where dK - dK_th is 1, in "
                      "units of length / (stress sqrt(length))^m. Allowed: a "
                      "number greater than 0 where it is used",
                      not_negative);
    prm.add_parameter("Paris exponent",
                      paris_exponent,
                      "m, a pure number.",
                      NumberPattern(Ranges::positive));
    prm.add_parameter("Paris threshold",
                      paris_threshold,
                      "dK_th, in units of stress sqrt(length): the crack does "
                      "not grow below it.",
                      not_negative);
    add_selection("Creep growth parameter", creep_parameter, prm);
    prm.add_parameter("Creep factor",
                      creep_factor,
                      "D, the speed where P is 1, in units of length / time / "
                      "P^phi; P is in units of stress length / time where it "
                      "is C*, of stress sqrt(length) where it is K_I. Allowed: "
                      "a number greater than 0 where it is used",
                      not_negative);
    prm.add_parameter("Creep exponent",
                      creep_exponent,
                      "phi, a pure number.",
                      NumberPattern(Ranges::positive));
  }



  void
  OutputParameters::add_parameters(ParameterHandler &prm)
  {
    probes.add_parameter("Probes",
                         "Points whose displacement and stress are recorded at "
                         "every step, in files named after them; coordinates "
                         "are in units of length. \"automatic\": the mouth of "
                         "a built-in crack. Allowed: automatic, or a list such "
                         "as tip: 0.5, 0; corner: 1, 1, with as many "
                         "coordinates as dimensions",
                         prm);
    field_times.add_parameter(
      "Field times",
      "Instants within the last period at which the fields are written, "
      "besides the end of the run, in units of time. \"automatic\": those of "
      "the largest opening and contact force, and of the largest and smallest "
      "stress intensity in the plane, else of the largest stress. Allowed: "
      "automatic, all, a number of equally spaced instants such as 12 "
      "instants, or numbers from 0 to the period, separated by commas",
      prm);
    add_selection("Fields", fields, prm);
    add_selection("Elastic comparison", elastic_comparison, prm);
    prm.add_parameter("Load work",
                      load_work,
                      "Whether the work of the loads in the displacement is "
                      "recorded at every step, for studies of convergence in "
                      "the energy norm.");
    prm.add_parameter("Checkpoint every",
                      checkpoint_every,
                      "Number of periods after which a checkpoint is written, "
                      "from which --resume continues; one more is written at "
                      "the end. 0: only on a request to stop, on SIGUSR1, and "
                      "at the end of a run that is not periodic.",
                      Integer(0));
  }
} // namespace Crevasse
