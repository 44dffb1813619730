// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_parameters_load_parameters_h
#define crevasse_parameters_load_parameters_h

#include <crevasse/parameters/boundary_roles.h>
#include <crevasse/parameters/checker.h>
#include <crevasse/parameters/formulas.h>

namespace Crevasse
{
  /** Formulas of a load where it acts. */
  struct PlacedFormulas
  {
    /** Boundaries; automatic: all that have the load's role. */
    BoundaryList            boundaries;
    std::vector<Expression> components;
    /** Numbers from 0 of the components that are "free"; their formula is 0. */
    std::set<unsigned int> free;

    bool
    act_on(const dealii::types::boundary_id id) const
    {
      return boundaries.is_automatic || boundaries.ids.count(id) > 0;
    }
  };

  using LoadFormulas = Parsed<std::vector<PlacedFormulas>>;

  /** Formulas of all boundaries. */
  std::vector<Expression>
  formulas_of(const LoadFormulas &values);

  /** Checks the boundaries that have values of their own.
   * @param allowed boundaries with the role that they must have. */
  void
  check_boundaries(const Checker                              &checker,
                   const char                                 *parameter,
                   const LoadFormulas                         &values,
                   const std::string                          &role,
                   const std::set<dealii::types::boundary_id> &allowed);

  /** Formulas that act on a boundary, or null. */
  const PlacedFormulas *
  placed_on(const dealii::types::boundary_id id, const LoadFormulas &values);

  /** Parses formulas for all boundaries of a role, "f; g", or by boundary:
   * "top: f; g | 2, left: f; g". @param parse of one boundary. */
  LoadFormulas::Parser
  on_boundaries(const Formulas::Parser &parse);

  /** Parses displacements by boundary, "f; free", or their rates. */
  LoadFormulas::Parser
  displacements(const std::string &name,
                const std::string &variables,
                const Tables      &tables);

  /** Parses formulas of a load in the volume, "f; g". */
  LoadFormulas::Parser
  in_volume(const Formulas::Parser &parse);

  struct LoadParameters : FormulaParsers
  {
    static constexpr const char *section = "Loads";

    double period = 1.;
    /** Formulas of x, y, z, t, one per component, separated by ";"; empty
     * without such a load. */
    LoadFormulas traction{"", on_boundaries(load_components("Traction"))};
    LoadFormulas pressure{"", on_boundaries(load_components("Pressure"))};
    LoadFormulas body_force{"", in_volume(load_components("Body force"))};
    LoadFormulas displacement{
      "",
      displacements("Displacement",
                    Expression::Variables::space_and_time,
                    tables)};
    LoadFormulas displacement_rate{"",
                                   displacements("Displacement rate",
                                                 Expression::Variables::space,
                                                 tables)};
    /** Temperature: a formula of x, y, z, t; no value: the name of a file. */
    Parsed<std::optional<Expression>> temperature{"0", temperature_formula()};
    /** Absolute temperature without strain; no value: theta is a change. */
    Parsed<std::optional<double>> reference{"", parse_optional_number};

    /** A force on the body. A force in the volume is an effect. */
    struct Force
    {
      const char         *parameter;
      const char         *effect; ///< name of the effect in the log
      const LoadFormulas &values;
      bool in_volume;    ///< force in the volume, else on a boundary
      bool along_normal; ///< one component, into the body

      /** Formulas of all boundaries. */
      std::vector<Expression>
      formulas() const
      {
        return formulas_of(values);
      }
    };

    /** All forces: code that handles one handles each. */
    std::array<Force, 3>
    forces() const;

    void
    add_parameters(dealii::ParameterHandler &prm);
    void
    check(Problems &problems) const;
    /** Checks the numbers of components. */
    void
    check_dimension(const unsigned int dimension, Problems &problems) const;
    /** Checks the boundaries that have values of their own. */
    void
    check_boundaries(const BoundaryRoles &roles, Problems &problems) const;

  private:
    void
    check_displaced(const BoundaryRoles &roles, Problems &problems) const;
  };

  /** A parameter that may have values by boundary, and the role of these. */
  struct LoadOnBoundaries
  {
    const char  *parameter;
    LoadFormulas LoadParameters::       *values;
    const char                          *role;
    std::set<dealii::types::boundary_id> BoundaryRoles::*ids;
    bool                                                 has_one_component;
  };

  constexpr LoadOnBoundaries loads_on_boundaries[] = {
    {"Traction",
     &LoadParameters::traction,
     "Loaded",
     &BoundaryRoles::loaded,
     false},
    {"Pressure",
     &LoadParameters::pressure,
     "Loaded",
     &BoundaryRoles::loaded,
     true},
    {"Displacement",
     &LoadParameters::displacement,
     "Displaced",
     &BoundaryRoles::displaced,
     false},
    {"Displacement rate",
     &LoadParameters::displacement_rate,
     "Displaced",
     &BoundaryRoles::displaced,
     false}};
} // namespace Crevasse

#endif
