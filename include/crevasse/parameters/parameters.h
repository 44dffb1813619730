// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_parameters_parameters_h
#define crevasse_parameters_parameters_h

#include <crevasse/base/problems.h>

#include <deal.II/base/parameter_handler.h>

#include <string>
#include <vector>

namespace Crevasse
{
  /**
   * One plain struct for each section of a scene file. Every struct declares
   * its own entries (name, default, documentation) with add_parameters(),
   * called inside the section, and then judges the values in check(), which
   * appends what is wrong to a list instead of stopping at the first error.
   *
   * All quantities are in the user's own consistent units.
   */
  struct GeometryParameters
  {
    static constexpr const char *section = "Geometry";

    std::string shape        = "edge crack";
    double      width        = 1.;
    double      height       = 1.;
    double      thickness    = 1.; ///< in three dimensions only
    double      crack_length = 0.5;
    std::string mesh_file;

    /** Cells along x, y, z of the coarse mesh before `refinements`. */
    std::vector<unsigned int> subdivisions = {14, 4};

    /** Uniform refinements of the coarse mesh. */
    unsigned int refinements = 0;

    void
    add_parameters(dealii::ParameterHandler &prm);
    void
    check(Problems &problems) const;
  };

  /** Which boundary ids play which role, and point supports. */
  struct BoundaryParameters
  {
    static constexpr const char *section = "Boundary";

    /** Lists of boundary ids, or "automatic" (what the built-in shape has). */
    std::string clamped  = "automatic";
    std::string symmetry = "automatic";
    std::string loaded   = "automatic";
    std::string contact  = "automatic";
    /** "x, y" or "x, y: 1" (only component 1), separated by ";", or
     * "automatic". */
    std::string fixed_points = "automatic";
    /** Expression of x, y, z: the least u_N of the lip, at most 0. */
    std::string gap = "0";

    void
    add_parameters(dealii::ParameterHandler &prm);
    void
    check(Problems &problems) const;
  };

  struct MaterialParameters
  {
    static constexpr const char *section = "Material";

    // Formulas of x, y, z, t, theta and material but for the time factors,
    // which depend on t alone.
    std::string plane_state           = "plane stress";
    std::string young_modulus         = "1";
    std::string poisson_ratio         = "0.3";
    std::string stiffness_matrix      = ""; ///< empty: isotropic
    std::string stiffness_time_factor = "1";
    std::string viscosity             = "relaxation time";
    std::string relaxation_time       = "1";
    std::string viscous_modulus       = "1";
    std::string viscous_poisson_ratio = "0.3";
    std::string viscosity_matrix      = "";
    std::string viscosity_time_factor = "1";
    /** "fraction: time; fraction: time". */
    std::string chain             = "";
    std::string thermal_expansion = "0";

    void
    add_parameters(dealii::ParameterHandler &prm);
    void
    check(Problems &problems) const;
  };

  struct LoadParameters
  {
    static constexpr const char *section = "Loads";

    double period = 1.;
    /** Expressions of x, y, z, t, one per component, separated by ";"; nothing
     * if there is no such load. */
    std::string traction;
    std::string body_force;
    /** Change of temperature: a formula of x, y, z, t, or a file. */
    std::string temperature = "0";

    void
    add_parameters(dealii::ParameterHandler &prm);
    void
    check(Problems &problems) const;
  };

  struct DiscretisationParameters
  {
    static constexpr const char *section = "Discretisation";

    unsigned int degree = 1;
    /** full | mean (B-bar: the mean dilatation of each cell). */
    std::string volumetric_strain = "full";
    /** At the crack tip: 1: w₁, 2: and D, 3: and w₃ (SingularFunctions). */
    unsigned int singular_functions = 0;

    void
    add_parameters(dealii::ParameterHandler &prm);
    void
    check(Problems &problems) const;
  };

  struct ContactParameters
  {
    static constexpr const char *section = "Contact";

    std::string solver = "automatic";
    /** A number in ]0,2[ or "automatic" (dichotomy). */
    std::string  relaxation_factor  = "automatic";
    double       tolerance          = 1e-12;
    unsigned int maximum_iterations = 100000;
    /** Factors of a table of iterations against the factor (paper, Table 1);
     * empty: no table. */
    std::vector<double> relaxation_table;

    void
    add_parameters(dealii::ParameterHandler &prm);
    void
    check(Problems &problems) const;
  };

  struct LinearSolverParameters
  {
    static constexpr const char *section = "Linear solver";

    std::string type = "automatic";
    /** By how much an iterative solver reduces the residual before the active
     * set is looked at again. */
    double tolerance = 1e-3;
    /** Mebibytes for what varies in time and is kept from period to period. */
    double memory_for_instants = 4000.;

    void
    add_parameters(dealii::ParameterHandler &prm);
    void
    check(Problems &problems) const;
  };

  struct TimeIntegrationParameters
  {
    static constexpr const char *section = "Time integration";

    /** Of a period: more would not end. */
    static constexpr unsigned int most_steps = 1000000;

    std::string  scheme           = "heun";
    double       heun_weight      = 0.75;
    unsigned int steps_per_period = 40;
    std::string  step_control     = "uniform";
    /** Instants within [0, Period] of the step control "list". */
    std::vector<double> steps;
    /** Of the stress: relative to the largest elastic one, and in its units. */
    double       relative_tolerance    = 1e-4;
    double       absolute_tolerance    = 0.;
    unsigned int order                 = 4; ///< of ARKODE's methods
    bool         locate_contact_events = false;
    /** Whether steps beyond the limit of the scheme are refused. */
    bool check_stability = true;

    void
    add_parameters(dealii::ParameterHandler &prm);
    void
    check(Problems &problems) const;
  };

  /** Whether the scheme is one of the library ARKODE. */
  bool
  uses_arkode(const TimeIntegrationParameters &parameters);

  struct PeriodicStateParameters
  {
    static constexpr const char *section = "Periodic state";

    std::string  method          = "march";
    std::string  start_from      = "rest";
    std::string  secular_split   = "automatic";
    unsigned int maximum_periods = 100;
    /** Estimated error of the stress, relative to its maximum, at which the
     * search ends. 0: all maximum_periods are computed. */
    double       tolerance        = 1e-6;
    unsigned int anderson_depth   = 15;
    double       anderson_damping = 1.;
    unsigned int anderson_delay   = 0;
    std::string  harmonics        = "trapezoid";

    void
    add_parameters(dealii::ParameterHandler &prm);
    void
    check(Problems &problems) const;
  };

  struct OutputParameters
  {
    static constexpr const char *section = "Output";

    /** "name: x, y; name: x, y". */
    std::string probes;
    /** Instants within the period of the field output of the last period. */
    std::vector<double> field_times;
    std::string         fields = "vtu";
    /** none | open | closed: compare the last period's stress with the
     * elastic one of an open or closed lip. */
    std::string elastic_comparison = "none";
    bool        load_work          = false;
    /** Periods from one checkpoint to the next; 0: only on request. */
    unsigned int checkpoint_every = 0;

    void
    add_parameters(dealii::ParameterHandler &prm);
    void
    check(Problems &problems) const;
  };
} // namespace Crevasse

#endif
