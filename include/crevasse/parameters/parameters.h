// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_parameters_parameters_h
#define crevasse_parameters_parameters_h

#include <crevasse/base/problems.h>
#include <crevasse/parameters/boundary_roles.h>
#include <crevasse/parameters/field_times.h>
#include <crevasse/parameters/formulas.h>
#include <crevasse/parameters/probe_list.h>
#include <crevasse/parameters/selections.h>
#include <crevasse/parameters/solver_selections.h>

namespace Crevasse
{
  /** "automatic" gives none.
   *
   * @throw SceneError that says what is expected. */
  std::vector<unsigned int>
  parse_subdivisions(const std::string &text);

  /**
   * One plain struct for each section of a scene file. Every struct declares
   * its own entries (name, default, documentation, range) with
   * add_parameters(), called inside the section. What several values together
   * say it judges in check(), which appends what is wrong to a list instead of
   * stopping at the first error.
   *
   * All quantities are in the user's own consistent units.
   */
  struct GeometryParameters
  {
    static constexpr const char *section = "Geometry";

    Shape       shape        = Shape::edge_crack;
    double      width        = 1.;
    double      height       = 1.;
    double      thickness    = 1.; ///< in three dimensions only
    double      crack_length = 0.5;
    std::string mesh_file;

    /** Cells along x, y, z of the coarse mesh before `refinements`; none: see
     * subdivisions(). */
    Parsed<std::vector<unsigned int>> subdivisions{"automatic",
                                                   parse_subdivisions};

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

    Parsed<BoundaryList>   clamped{"automatic", parse_boundary_list};
    Parsed<BoundaryList>   symmetry{"automatic", parse_boundary_list};
    Parsed<BoundaryList>   loaded{"automatic", parse_boundary_list};
    Parsed<BoundaryList>   contact{"automatic", parse_boundary_list};
    Parsed<BoundaryList>   crack{"none", parse_boundary_list};
    Parsed<FixedPointList> fixed_points{"automatic", parse_fixed_points};
    /** The least u_N of the lip. */
    Formula gap{"0", parse_gap};

    void
    add_parameters(dealii::ParameterHandler &prm);
    void
    check(Problems &problems) const;
  };

  /** A role: its parameter, and the boundaries that have it in the end. */
  struct BoundaryRole
  {
    const char          *name;
    Parsed<BoundaryList> BoundaryParameters::*list;
    std::set<dealii::types::boundary_id> BoundaryRoles::*ids;
  };

  constexpr BoundaryRole boundary_role_table[] = {
    {"Clamped", &BoundaryParameters::clamped, &BoundaryRoles::clamped},
    {"Symmetry", &BoundaryParameters::symmetry, &BoundaryRoles::symmetry},
    {"Loaded", &BoundaryParameters::loaded, &BoundaryRoles::loaded},
    {"Contact", &BoundaryParameters::contact, &BoundaryRoles::contact},
    {"Crack", &BoundaryParameters::crack, &BoundaryRoles::crack}};

  struct MaterialParameters
  {
    static constexpr const char *section = "Material";

    PlaneState    plane_state = PlaneState::plane_stress;
    ViscosityType viscosity   = ViscosityType::relaxation_time;

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
    Formula creep_coefficient{"1",
                              material_formula("Creep coefficient",
                                               Ranges::coefficient)};
    Formula creep_exponent{"1",
                           material_formula("Creep exponent",
                                            Ranges::creep_exponent)};
    FormulaMatrix viscosity_matrix{"", material_matrix("Viscosity matrix")};
    Formula viscosity_time_factor{"1", time_factor("Viscosity time factor")};
    Parsed<std::vector<ChainBranch>> chain{"", parse_chain};
    Formulas thermal_expansion{"0", material_components("Thermal expansion")};

    /** A strain that the body has without stress: an effect. */
    struct FreeStrain
    {
      const char     *parameter;
      const char     *effect; ///< its name in the log
      const Formulas &components;
      bool            is_thermal; ///< to be multiplied by theta
    };

    /** All of them: whatever looks at one looks at each. */
    std::vector<FreeStrain>
    free_strains() const;

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
    Formulas traction{"", load_components("Traction")};
    Formulas body_force{"", load_components("Body force")};
    /** Change of temperature: a formula of x, y, z, t, or nothing where the
     * text is the name of a file. */
    Parsed<std::optional<Expression>> temperature{"0", parse_temperature};

    /** A force on the body. In its volume it is an effect. */
    struct Force
    {
      const char     *parameter;
      const char     *effect; ///< its name in the log
      const Formulas &components;
      bool            in_volume; ///< or on boundaries with the role Loaded
    };

    /** All of them: whatever looks at one looks at each. */
    std::vector<Force>
    forces() const;

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
    /** At the crack tip: 1: w₁, 2: and D, 3: and w₃ (SingularFunctions). */
    SingularFunctionNumber singular_functions =
      SingularFunctionNumber::automatic;

    void
    add_parameters(dealii::ParameterHandler &prm);
    void
    check(Problems &problems) const;
  };

  /** How the mesh is refined besides [Geometry] Refinements. */
  struct RefinementParameters
  {
    static constexpr const char *section = "Refinement";

    RefinementStrategy strategy = RefinementStrategy::none;
    /** Refinement ends when the mesh has them; 0: no limit. */
    unsigned int target_unknowns = 0;
    /** tip: levels; adaptive: meshes after the first. 0: by the target. */
    unsigned int cycles           = 0;
    Marking      marking          = Marking::bulk;
    double       refine_fraction  = 0.5;
    double       coarsen_fraction = 0.;
    /** Estimated error of the stress in the energy norm, relative to that of
     * the stress, at which cycles end; 0: none. */
    double tolerance = 0.;
    /** Instants within the period that the estimate looks at; none: those of
     * the largest load and of the most opposite one. */
    std::vector<double> instants;
    /** Periods after which the mesh is adapted again; 0: never. */
    unsigned int readapt_every = 0;

    void
    add_parameters(dealii::ParameterHandler &prm);
    void
    check(Problems &problems) const;
  };

  /** Those with which over-relaxation converges. */
  constexpr Range relaxation_factors = {Ranges::above_0,
                                        2. - 1e-15,
                                        "greater than 0 and less than 2"};

  /** A factor, or "automatic".
   *
   * @throw SceneError that says what is expected. */
  std::optional<double>
  parse_relaxation_factor(const std::string &text);

  struct ContactParameters
  {
    static constexpr const char *section = "Contact";

    ContactSolverType solver = ContactSolverType::automatic;
    /** Within ]0,2[; nothing: found by dichotomy. */
    Parsed<std::optional<double>> relaxation_factor{"automatic",
                                                    parse_relaxation_factor};
    double                        tolerance          = 1e-12;
    unsigned int                  maximum_iterations = 100000;
    /** Factors of a table of iterations against the factor (paper, Table 1);
     * empty: no table. */
    std::vector<double> relaxation_table;

    /** Of the body, as projected SOR and the table do. */
    bool
    needs_matrix() const
    {
      return traits(solver).relaxes || !relaxation_table.empty();
    }

    void
    add_parameters(dealii::ParameterHandler &prm);
  };

  struct LinearSolverParameters
  {
    static constexpr const char *section = "Linear solver";

    LinearSolverType type = LinearSolverType::automatic;
    /** By how much an iterative solver reduces the residual before the active
     * set is looked at again. */
    double tolerance = 1e-3;
    /** Mebibytes for what varies in time and is kept from period to period. */
    double memory_for_instants = 4000.;

    void
    add_parameters(dealii::ParameterHandler &prm);
  };

  struct TimeIntegrationParameters
  {
    static constexpr const char *section = "Time integration";

    /** Of a period: more would not end. */
    static constexpr unsigned int most_steps = 1000000;

    Scheme          scheme           = Scheme::automatic;
    double          heun_weight      = 0.75;
    unsigned int    steps_per_period = 80;
    StepControlType step_control     = StepControlType::uniform;
    /** Instants within [0, Period] of the step control "list". */
    std::vector<double> steps;
    /** Of the stress: relative to the largest elastic one, and in its units. */
    double relative_tolerance = 1e-4;
    double absolute_tolerance = 0.;
    /** Of the stages of implicit schemes where creep follows a power law. */
    double       newton_tolerance      = 1e-7;
    unsigned int order                 = 4; ///< of ARKODE's methods
    bool         locate_contact_events = false;
    /** Whether steps beyond the limit of the scheme are refused. */
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
    StartFrom          start_from      = StartFrom::rest;
    SecularSplitType   secular_split   = SecularSplitType::automatic;
    unsigned int       maximum_periods = 100;
    /** Estimated error of the stress, relative to its maximum, at which the
     * search ends. 0: all maximum_periods are computed. */
    double       tolerance        = 1e-6;
    unsigned int anderson_depth   = 15;
    double       anderson_damping = 1.;
    unsigned int anderson_delay   = 0;
    HarmonicRule harmonics        = HarmonicRule::trapezoid;

    void
    add_parameters(dealii::ParameterHandler &prm);
  };

  /** What is read off at the crack tip. */
  struct CrackTipParameters
  {
    static constexpr const char *section = "Crack tip";

    StressIntensityChoice stress_intensity = StressIntensityChoice::automatic;
    bool                  creep_integral   = false;
    StressIntensityMethod method           = StressIntensityMethod::automatic;
    /** Half the side of the square around the tip that the integral extends
     * over, or twice the radius of the smaller disc of the fit; 0: automatic.
     */
    double radius = 0.;

    GrowthLawType growth_law = GrowthLawType::none;
    // da/dN = C (ΔK − ΔK_th)^m or, without a threshold, C ΔK^m.
    double paris_factor    = 0.;
    double paris_exponent  = 3.;
    double paris_threshold = 0.;
    /** What drives da/dt = D (...)^φ. */
    CreepParameter creep_parameter = CreepParameter::C_star;
    double         creep_factor    = 0.;
    double         creep_exponent  = 1.;

    void
    add_parameters(dealii::ParameterHandler &prm);
    void
    check(Problems &problems) const;

    /** Whether what drives the growth is C(t). */
    bool
    grows_by_C_of_t() const;

    /** Whether K is asked for, by itself or for the growth. */
    bool
    needs_stress_intensity() const;

    /** Whether K is computed or the scene is refused: also where it says how.
     */
    bool
    demands_stress_intensity() const
    {
      return needs_stress_intensity() || radius > 0. ||
             method != StressIntensityMethod::automatic;
    }
  };

  struct OutputParameters
  {
    static constexpr const char *section = "Output";

    Parsed<std::vector<NamedPoint>> probes{"automatic", parse_probes};
    Parsed<FieldTimes>              field_times{"automatic", parse_field_times};
    FieldFormat                     fields = FieldFormat::vtu;
    /** Of the last period's stress with the elastic one. */
    ComparedLip elastic_comparison = ComparedLip::none;
    bool        load_work          = false;
    /** Periods from one checkpoint to the next; 0: only on request. */
    unsigned int checkpoint_every = 0;

    void
    add_parameters(dealii::ParameterHandler &prm);
  };
} // namespace Crevasse

#endif
