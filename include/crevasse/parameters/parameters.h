// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_parameters_parameters_h
#define crevasse_parameters_parameters_h

#include <crevasse/base/problems.h>
#include <crevasse/parameters/boundary_roles.h>
#include <crevasse/parameters/crack_tip_parameters.h>
#include <crevasse/parameters/field_times.h>
#include <crevasse/parameters/formulas.h>
#include <crevasse/parameters/load_parameters.h>
#include <crevasse/parameters/probe_list.h>
#include <crevasse/parameters/selections.h>
#include <crevasse/parameters/solver_selections.h>

namespace Crevasse
{
  /** Parses subdivisions; "automatic" gives an empty list. @throw SceneError */
  std::vector<unsigned int>
  parse_subdivisions(const std::string &text);

  /** Parses pairs of a number of periods and the crack length after them. */
  std::map<unsigned int, double>
  parse_crack_growth(const std::string &text);

  /**
   * Parameters of section Geometry. Each section of a scene file has a plain
   * struct, which declares its entries (name, default, documentation, range) in
   * add_parameters(), called inside the section. Its check() judges
   * combinations of values, and appends all errors to a list instead of
   * stopping at the first. All quantities are in the user's consistent units.
   */
  struct GeometryParameters
  {
    static constexpr const char *section = "Geometry";

    Shape  shape        = Shape::edge_crack;
    double width        = 1.;
    double height       = 1.;
    double thickness    = 1.;  ///< thickness in three dimensions
    double crack_length = 0.5; ///< present length
    /** Lengths to which the crack grows after numbers of periods. */
    Parsed<std::map<unsigned int, double>> crack_growth{"", parse_crack_growth};
    std::string                            mesh_file;
    std::string converted_mesh_file; ///< Gmsh file made from mesh_file
    const std::string &
    file_to_read() const
    {
      return converted_mesh_file.empty() ? mesh_file : converted_mesh_file;
    }

    /** Cells along x, y, z of the coarse mesh; empty: automatic, see
     * Crevasse::subdivisions(). */
    Parsed<std::vector<unsigned int>> subdivisions{"automatic",
                                                   parse_subdivisions};

    /** Uniform refinements of the coarse mesh. */
    unsigned int refinements = 0;

    void
    add_parameters(dealii::ParameterHandler &prm);
    void
    check(Problems &problems) const;
  };

  /** Parameters of section Boundary: roles of boundary ids, fixed points. */
  struct BoundaryParameters : FormulaParsers
  {
    static constexpr const char *section = "Boundary";

    Parsed<BoundaryList>   clamped{"automatic", parse_boundary_list};
    Parsed<BoundaryList>   displaced{"none", parse_boundary_list};
    Parsed<BoundaryList>   symmetry{"automatic", parse_boundary_list};
    Parsed<BoundaryList>   loaded{"automatic", parse_boundary_list};
    Parsed<BoundaryList>   contact{"automatic", parse_boundary_list};
    Parsed<BoundaryList>   crack{"none", parse_boundary_list};
    Parsed<BoundaryList>   open_crack{"automatic", parse_boundary_list};
    Parsed<FixedPointList> fixed_points{"automatic", parse_fixed_points};
    /** Lower bound of u_N on the lip. */
    Formula gap{"0", gap_formula()};
    /** Coefficients of Coulomb's friction on lips that touch. */
    LoadFormulas friction{"0", on_boundaries(friction_coefficient())};

    void
    add_parameters(dealii::ParameterHandler &prm);
    void
    check(Problems &problems) const;
  };

  /** A role of boundaries: its parameter, and its resolved boundary ids. */
  struct BoundaryRole
  {
    const char          *name;
    Parsed<BoundaryList> BoundaryParameters::*list;
    std::set<dealii::types::boundary_id> BoundaryRoles::*ids;
    bool is_lip; ///< whether the boundaries may be loaded, too
  };

  constexpr BoundaryRole boundary_role_table[] = {
    {"Clamped", &BoundaryParameters::clamped, &BoundaryRoles::clamped, false},
    {"Displaced",
     &BoundaryParameters::displaced,
     &BoundaryRoles::displaced,
     false},
    {"Symmetry",
     &BoundaryParameters::symmetry,
     &BoundaryRoles::symmetry,
     false},
    {"Loaded", &BoundaryParameters::loaded, &BoundaryRoles::loaded, false},
    {"Contact", &BoundaryParameters::contact, &BoundaryRoles::contact, true},
    {"Crack", &BoundaryParameters::crack, &BoundaryRoles::crack, true},
    {"Open crack",
     &BoundaryParameters::open_crack,
     &BoundaryRoles::open,
     true}};

  struct MaterialParameters : FormulaParsers
  {
    static constexpr const char *section = "Material";

    PlaneState    plane_state = PlaneState::plane_stress;
    ViscosityType viscosity   = ViscosityType::relaxation_time;
    /** Temperature from which Thermal expansion is a mean; no value: reference.
     */
    Parsed<std::optional<double>> mean_expansion_from{"",
                                                      parse_optional_number};

    Formula       young_modulus{"1", material_formula("Young modulus")};
    Formula       poisson_ratio{"0.3",
                          material_formula("Poisson ratio",
                                           Ranges::elastic_ratio)};
    FormulaMatrix stiffness_matrix{"", material_matrix("Stiffness matrix")};
    Formula stiffness_time_factor{"1", time_factor("Stiffness time factor")};
    Formula relaxation_time{"1", material_formula("Relaxation time")};
    Formula viscous_modulus{"1", material_formula("Viscous modulus")};
    Formula viscous_poisson_ratio{"0.3",
                                  material_formula("Viscous Poisson ratio",
                                                   Ranges::viscous_ratio)};
    std::map<std::string, Formula> of_creep{}; ///< see CreepLawParameter
    FormulaMatrix viscosity_matrix{"", material_matrix("Viscosity matrix")};
    Formula viscosity_time_factor{"1", time_factor("Viscosity time factor")};
    Parsed<std::vector<ChainBranch>> chain{"", chain_parser()};
    Formula  chain_shift{"1", material_formula("Chain shift")};
    bool     chain_in_shear_only = false;
    Formulas thermal_expansion{"0", material_components("Thermal expansion")};

    /** Strain of the body without stress, which is an effect. */
    struct FreeStrain
    {
      const char     *parameter;
      const char     *effect; ///< name of the effect in the log
      const Formulas &components;
      bool            is_thermal; ///< whether theta causes it
    };

    /** All free strains: code that handles one handles each. */
    std::vector<FreeStrain>
    free_strains() const;

    /** Bodies of the chain, with shifted relaxation times. */
    std::vector<ChainBranch>
    branches() const;

    /** Whether the bulk modulus stays elastic while the shear modulus relaxes.
     */
    bool
    relaxes_in_shear_only() const
    {
      return viscosity == ViscosityType::chain && chain_in_shear_only;
    }

    /** Nonlinear creep law, or null. */
    const CreepLaw *
    creep_law() const
    {
      const auto law = traits(viscosity).creep_law;
      return law == nullptr ? nullptr : &law();
    }

    void
    add_parameters(dealii::ParameterHandler &prm);
    void
    check(Problems &problems) const;
  };

  struct DiscretisationParameters
  {
    static constexpr const char *section = "Discretisation";

    unsigned int     degree            = 2;
    VolumetricStrain volumetric_strain = VolumetricStrain::full;
    /** Crack-tip functions: 1: w₁, 2: also D, 3: also w₃ (SingularFunctions).
     */
    SingularFunctionNumber singular_functions =
      SingularFunctionNumber::automatic;

    void
    add_parameters(dealii::ParameterHandler &prm);
    void
    check(Problems &problems) const;
  };

  /** Parameters of section Refinement, after [Geometry] Refinements. */
  struct RefinementParameters
  {
    static constexpr const char *section = "Refinement";

    RefinementStrategy strategy = RefinementStrategy::none;
    /** Number of unknowns at which refinement ends; 0: no limit. */
    unsigned int target_unknowns = 0;
    /** Levels (tip) or meshes after the first (adaptive); 0: until target. */
    unsigned int cycles           = 0;
    Marking      marking          = Marking::bulk;
    double       refine_fraction  = 0.5;
    double       coarsen_fraction = 0.;
    /** Relative estimated error of the stress in the energy norm at which
     * cycles end; 0: none. */
    double tolerance = 0.;
    /** Instants within the period at which the error is estimated; empty:
     * instants of the largest and of the most opposite load. */
    std::vector<double> instants;
    /** Periods after which the mesh is adapted again; 0: never. */
    unsigned int readapt_every = 0;

    void
    add_parameters(dealii::ParameterHandler &prm);
    void
    check(Problems &problems) const;
  };

  /** Relaxation factors with which over-relaxation converges. */
  constexpr Range relaxation_factors = {Ranges::above_0,
                                        2. - 1e-15,
                                        "greater than 0 and less than 2"};

  /** Parses a relaxation factor; "automatic" gives no value.
   *
   * @throw SceneError that says what is expected. */
  std::optional<double>
  parse_relaxation_factor(const std::string &text);

  struct ContactParameters
  {
    static constexpr const char *section = "Contact";

    ContactSolverType solver = ContactSolverType::automatic;
    /** Relaxation factor in ]0,2[; no value: found by dichotomy. */
    Parsed<std::optional<double>> relaxation_factor{"automatic",
                                                    parse_relaxation_factor};
    double                        tolerance          = 1e-12;
    unsigned int                  maximum_iterations = 100000;
    /** Relaxation factors in a table of iterations (paper, Table 1); empty: no
     * table. */
    std::vector<double> relaxation_table;

    /** Whether contact needs the matrix of the body: for SOR or the table. */
    bool
    needs_matrix() const
    {
      return traits(solver).has(Trait::relaxes) || !relaxation_table.empty();
    }

    void
    add_parameters(dealii::ParameterHandler &prm);
  };

  struct LinearSolverParameters
  {
    static constexpr const char *section = "Linear solver";

    LinearSolverType type = LinearSolverType::automatic;
    /** Reduction of the residual by an iterative solver before the active set
     * is updated. */
    double tolerance = 1e-3;
    /** Mebibytes for time-dependent data kept from period to period. */
    double memory_for_instants = 4000.;

    void
    add_parameters(dealii::ParameterHandler &prm);
  };

  struct TimeIntegrationParameters
  {
    static constexpr const char *section = "Time integration";

    /** Largest number of steps per period: more would not end. */
    static constexpr unsigned int most_steps = 1000000;

    Scheme          scheme           = Scheme::automatic;
    double          heun_weight      = 0.75;
    unsigned int    steps_per_period = 80;
    StepControlType step_control     = StepControlType::uniform;
    /** Ends of steps in [0, Period] for the step control "list". */
    std::vector<double> steps;
    /** Tolerances of the stress: relative to the largest elastic; absolute. */
    double relative_tolerance = 1e-4;
    double absolute_tolerance = 0.;
    /** Newton tolerance in stages of implicit schemes for nonlinear creep. */
    double       newton_tolerance      = 1e-7;
    unsigned int order                 = 4; ///< order of ARKODE's methods
    bool         locate_contact_events = false;
    /** Whether steps beyond the stability limit are an error. */
    bool check_stability = true;

    void
    add_parameters(dealii::ParameterHandler &prm);
    void
    check(Problems &problems) const;
  };

  struct PeriodicStateParameters
  {
    static constexpr const char *section = "Periodic state";

    PeriodicMethodType method          = PeriodicMethodType::automatic;
    SecularSplitType   secular_split   = SecularSplitType::automatic;
    unsigned int       maximum_periods = 100;
    /** Estimated error of the stress, relative to its maximum, at which the
     * search ends. 0: all maximum_periods are computed. */
    double       tolerance      = 1e-6;
    unsigned int anderson_depth = 15;
    unsigned int averaged_poles = 2;
    /** Quantity that the tolerance is for: "stress", "K_I", "opening", or
     * "probe" and its name. */
    std::string               converged_quantity = "stress";
    std::vector<unsigned int> missions; ///< empty: the periodic state
    double                    mission_tolerance = 1e-2;
    HarmonicRule              harmonics         = HarmonicRule::trapezoid;

    void
    add_parameters(dealii::ParameterHandler &prm);
    void
    check(Problems &problems) const;
  };

  struct OutputParameters
  {
    static constexpr const char *section = "Output";

    Parsed<std::vector<NamedPoint>> probes{"automatic", parse_probes};
    Parsed<FieldTimes>              field_times{"automatic", parse_field_times};
    FieldFormat                     fields = FieldFormat::vtu;
    /** Lip of the elastic body to compare the last period's stress with. */
    ComparedLip elastic_comparison = ComparedLip::none;
    bool        load_work          = false;
    /** Number of periods between checkpoints; 0: only on request. */
    unsigned int checkpoint_every = 0;
    /** Whether companion runs give the results error bars. */
    bool error_bars = false;
    /** Whether StressWriter runs: sweeps set it, and no scene. */
    bool stress_record = false;
    /** How the run was started, for the summary. */
    std::vector<std::string> command_line;

    void
    add_parameters(dealii::ParameterHandler &prm);
  };
} // namespace Crevasse

#endif
