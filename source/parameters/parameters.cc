// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/parameters/parameters.h>

#include <deal.II/base/patterns.h>

namespace Crevasse
{
  using namespace dealii;

  // The patterns tell types only; ranges are left to check(), which can say in
  // words what is allowed. What follows "Allowed:" is the last column of the
  // parameter tables of the documentation.
  namespace
  {
    const Patterns::Integer any_count(0);
    const Patterns::List    list_of_counts(Patterns::Integer(0));
    const Patterns::List    list_of_numbers(Patterns::Double{});
  } // namespace



  void
  GeometryParameters::add_parameters(ParameterHandler &prm)
  {
    add_selection("Shape", shape, prm);
    prm.add_parameter("Width",
                      width,
                      "Extent in x of a built-in shape, in units of length. "
                      "Allowed: a number greater than 0");
    prm.add_parameter("Height",
                      height,
                      "Extent in y of a built-in shape above the crack plane, "
                      "in units of length. Allowed: a number greater than 0");
    prm.add_parameter("Thickness",
                      thickness,
                      "Extent in z of a built-in shape in three dimensions, "
                      "from z = 0 on, in units of length; not used in two. "
                      "Allowed: a number greater than 0");
    prm.add_parameter("Crack length",
                      crack_length,
                      "Length of the modelled part of the crack, in units of "
                      "length; used by the two shapes with a crack. Allowed: a "
                      "number greater than 0 and less than Width");
    prm.add_parameter(
      "Mesh file",
      mesh_file,
      "Mesh of quadrilaterals (in three dimensions: of hexahedra) with "
      "boundary ids, for the shape \"mesh file\". "
      "It is looked for next to the scene file first, then in the working "
      "directory. Allowed: a Gmsh file (.msh) or another format that deal.II "
      "reads");
    prm.add_parameter(
      "Subdivisions",
      subdivisions,
      "Numbers of cells along x and y (and z) of a built-in "
      "shape, before refinement. Where equal cells do not meet the "
      "crack tip, the two sides of it are divided separately. "
      "Allowed: as many integers of at least 1 as dimensions, "
      "separated by commas",
      list_of_counts);
    prm.add_parameter("Refinements",
                      refinements,
                      "How often all cells are halved in each direction. "
                      "Allowed: an integer from 0 to 12",
                      any_count);
  }



  void
  BoundaryParameters::add_parameters(ParameterHandler &prm)
  {
    const std::string ids =
      " Sides of built-in shapes: 0 left, 1 right, 2 bottom, except the crack "
      "lip, 3 top, 4 crack lip, 5 z = 0, 6 z = Thickness.";
    const std::string automatic = " \"automatic\" is ";
    const std::string others =
      " for a built-in shape, except ids that another role names, and none "
      "for a mesh file";
    const std::string allowed =
      ". Allowed: automatic, none, or boundary ids separated by commas; of a "
      "Gmsh file also names of physical groups";

    prm.add_parameter("Clamped",
                      clamped,
                      "Boundary ids where the displacement is zero." + ids +
                        automatic + "none" + allowed);
    prm.add_parameter("Symmetry",
                      symmetry,
                      "Boundary ids of symmetry planes: the normal "
                      "displacement and the tangential traction are zero." +
                        automatic + "2 (and 0 with a centre crack)" + others +
                        allowed);
    prm.add_parameter("Loaded",
                      loaded,
                      "Boundary ids that carry the traction of the section "
                      "Loads." +
                        automatic + "3" + others + allowed);
    prm.add_parameter("Contact",
                      contact,
                      "Boundary ids of crack lips, which may open but not go "
                      "through the crack plane." +
                        automatic + "4 (none without a crack)" + others +
                        allowed);
    prm.add_parameter(
      "Fixed points",
      fixed_points,
      "Mesh vertices that are fixed against rigid-body motion, in all "
      "directions or in the components, counted from 1, after a colon; "
      "coordinates are in units of length. \"automatic\" prevents the motions "
      "of a built-in shape along the crack plane that clamped sides and "
      "symmetry planes allow, and is none for a mesh file. Allowed: automatic, "
      "none, or a list such as 0, 0; 1, 0: 2");
    gap.add_parameter("Gap",
                      "The least normal displacement of the lip, in units of "
                      "length: 0 for a crack that is closed when nothing is "
                      "loaded, negative for one that stands open. Allowed: a "
                      "formula of x, y, z with values of at most 0",
                      prm);
  }



  void
  LoadParameters::add_parameters(ParameterHandler &prm)
  {
    prm.add_parameter("Period",
                      period,
                      "Period of everything that depends on time, in units of "
                      "time. In all formulas t is the time within the period. "
                      "Allowed: a number greater than 0");
    traction.add_parameter(
      "Traction",
      "Force per area on the boundaries that Boundary/Loaded "
      "names, in units of stress; nothing: none. Allowed: one "
      "formula of x, y, z, t for each dimension, separated by "
      "semicolons",
      prm);
    temperature.add_parameter(
      "Temperature",
      "Change of the temperature theta against that at which "
      "nothing is strained, in units of temperature. It "
      "strains the body by Thermal "
      "expansion, and the formulas of the material may depend "
      "on it. Allowed: a formula of x, y, z, t; a .csv file "
      "with the columns t, x, y, theta (t, x, y, z, theta in "
      "three dimensions): a rectangular grid of points, the "
      "same at each instant, between which is interpolated; "
      "or an .h5 file, made of the fields of another program "
      "by \"crevasse temperature\"",
      prm);
    body_force.add_parameter(
      "Body force",
      "Force per volume, in units of stress / length; nothing: "
      "none. Allowed: one formula of x, y, z, t for each "
      "dimension, separated by semicolons",
      prm);
  }



  void
  DiscretisationParameters::add_parameters(ParameterHandler &prm)
  {
    prm.add_parameter("Degree",
                      degree,
                      "Polynomial degree of the finite elements. Allowed: 1 or "
                      "2",
                      any_count);
    add_selection("Volumetric strain", volumetric_strain, prm);
    prm.add_parameter(
      "Singular functions",
      singular_functions,
      "Number of functions with the singularity of the crack tip that are "
      "added to the finite elements: 1: that of a unit K_I, 2: also the other "
      "one with the square root of r, for a viscous Poisson ratio other than "
      "the elastic one, 3: also that with the power 3/2. "
      "Allowed: 0 to 3",
      any_count);
  }



  void
  ContactParameters::add_parameters(ParameterHandler &prm)
  {
    add_selection("Solver", solver, prm);
    relaxation_factor.add_parameter(
      "Relaxation factor",
      "Over-relaxation factor of the projected SOR method; "
      "\"automatic\" searches for the best one. Allowed: "
      "automatic, or a number greater than 0 and less than 2",
      prm);
    prm.add_parameter("Tolerance",
                      tolerance,
                      "Largest error that the certificate of a solution may "
                      "show: penetration and complementarity relative to the "
                      "largest displacement, tension and residual relative to "
                      "the largest nodal force of the loads. Where rounding "
                      "does not allow so much, what it does allow counts. "
                      "Allowed: a number greater than 0, at most 0.01");
    prm.add_parameter("Maximum iterations",
                      maximum_iterations,
                      "Iterations after which the solvers \"projected sor\" "
                      "(sweeps) and \"active set\" (sets) give up. Allowed: "
                      "an integer from 1 to 2147483647",
                      any_count);
    prm.add_parameter("Relaxation table",
                      relaxation_table,
                      "Relaxation factors for which the iterations are counted "
                      "and tabulated; nothing: no table. Allowed: numbers "
                      "greater than 0 and less than 2, separated by commas",
                      list_of_numbers);
  }



  void
  LinearSolverParameters::add_parameters(ParameterHandler &prm)
  {
    add_selection("Type", type, prm);
    prm.add_parameter("Tolerance",
                      tolerance,
                      "Factor by which conjugate gradients reduce the residual "
                      "before the solver \"active set\" updates its set; "
                      "[Contact] Tolerance bounds the error of the result. "
                      "Allowed: a number greater than 0, at most 0.1");
    prm.add_parameter("Memory for instants",
                      memory_for_instants,
                      "Memory in MiB for matrices, factors and material data "
                      "that vary in time (not by a factor only): those of as "
                      "many instants of the period as it holds are kept, for "
                      "the others they are made anew in each period. Allowed: "
                      "a number of at least 0");
  }



  void
  TimeIntegrationParameters::add_parameters(ParameterHandler &prm)
  {
    add_selection("Scheme", scheme, prm);
    prm.add_parameter("Heun weight",
                      heun_weight,
                      "Weight w of the second stage of the scheme \"heun\", "
                      "which lies at the fraction 1/(2w) of the step. Allowed: "
                      "a number from 0.5 to 1");
    prm.add_parameter("Steps per period",
                      steps_per_period,
                      "Number of equal steps of the step control \"uniform\"; "
                      "with \"adaptive\" that of the longest steps, with the "
                      "schemes of arkode that of samples. Allowed: an "
                      "integer from 1 to 1000000",
                      any_count);
    add_selection("Step control", step_control, prm);
    prm.add_parameter("Steps",
                      steps,
                      "Instants of the step control \"list\", in units of "
                      "time; with \"adaptive\" those at which a step ends in "
                      "any case, as where a load jumps. Allowed: increasing "
                      "numbers from 0 to the period, "
                      "separated by commas",
                      list_of_numbers);
    prm.add_parameter("Relative tolerance",
                      relative_tolerance,
                      "Error of the stress that the step control \"adaptive\" "
                      "aims at, relative to the largest elastic stress of the "
                      "period. Allowed: a number of at least 0 "
                      "and less than 1");
    prm.add_parameter("Absolute tolerance",
                      absolute_tolerance,
                      "The same in units of stress; both are added. Allowed: a "
                      "number of at least 0");
    prm.add_parameter("Order",
                      order,
                      "Order of the schemes \"arkode explicit\" and \"arkode "
                      "implicit\". Allowed: an integer from 2 to 5",
                      Patterns::Integer(2, 5));
    prm.add_parameter("Locate contact events",
                      locate_contact_events,
                      "Whether steps are divided where nodes of the crack lip "
                      "open or close. Without that the kinks of the solution "
                      "limit every scheme to order 2. Allowed: true, false");
    prm.add_parameter("Check stability",
                      check_stability,
                      "Whether steps that are too long for a scheme with a "
                      "limit are refused. Without that they are taken, and the "
                      "stress grows from step to step. Allowed: true, false");
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
                      "the stress is not periodic. Allowed: an integer of at "
                      "least 0",
                      any_count);
    prm.add_parameter("Tolerance",
                      tolerance,
                      "Estimated error of the stress, relative to the largest "
                      "stress, at which the state counts as periodic; 0 "
                      "computes Maximum periods in any case. Allowed: a number "
                      "of at least 0, less than 1");
    prm.add_parameter("Anderson depth",
                      anderson_depth,
                      "Number of earlier periods that \"anderson\" combines "
                      "with the last one. Allowed: an integer of at least 1",
                      Patterns::Integer(1));
    prm.add_parameter("Anderson damping",
                      anderson_damping,
                      "Part of what the combination still misses that is added "
                      "to it. Allowed: a number greater than 0, at most 1");
    prm.add_parameter("Anderson delay",
                      anderson_delay,
                      "Periods that are marched before the first combination. "
                      "Allowed: an integer of at least 0",
                      any_count);
    add_selection("Harmonics", harmonics, prm);
  }



  void
  OutputParameters::add_parameters(ParameterHandler &prm)
  {
    probes.add_parameter(
      "Probes",
      "Points whose displacement and stress are recorded at "
      "every step, in files named after them; coordinates are "
      "in units of length. Allowed: a list "
      "such as tip: 0.5, 0; corner: 1, 1, with as many "
      "coordinates as dimensions",
      prm);
    prm.add_parameter("Field times",
                      field_times,
                      "Instants within the last period at which the fields are "
                      "written, in units of time. Allowed: numbers from 0 to "
                      "the period, separated by commas",
                      list_of_numbers);
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
                      "from which --resume continues; 0: only when the run is "
                      "asked to stop, or by SIGUSR1. Allowed: an integer of at "
                      "least 0",
                      Patterns::Integer(0));
  }
} // namespace Crevasse
