// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_parameters_effects_h
#define crevasse_parameters_effects_h

#include <crevasse/parameters/boundary_roles.h>
#include <crevasse/parameters/scene.h>

namespace Crevasse
{
  /** Which effects a scene calls for, decided once, each with its reason. What
   * is off is not created: it costs neither time nor memory. */
  struct Effects
  {
    struct Effect
    {
      std::string name;
      bool        on = false;
      std::string why;
    };

    Effect contact;
    Effect viscosity;
    Effect secular_flow; ///< off until somebody who knows the loads decides
    Effect chain;
    /** Those of MaterialParameters::free_strains(). */
    std::vector<Effect> free_strains;
    Effect              varying_stiffness; ///< by a factor or freely
    Effect              varying_viscosity;
    /** Those of LoadParameters::forces() in the volume. */
    std::vector<Effect> volume_forces;
    Effect              singular_functions;
    Effect              stress_intensity;
    Effect              field_output;

    /** @param temperature_varies whether [Loads] Temperature does in time. */
    Effects(const Scene         &scene,
            const BoundaryRoles &roles,
            const bool           temperature_varies);

    /** The first one that is on, or nullptr. */
    static const Effect *
    first_on(const std::vector<Effect> &effects);

    /** All of them, in a fixed order, for tables. */
    std::vector<Effect>
    list() const;
  };

  // What the formulas that a scene uses depend on. The scene must have passed
  // its check.

  /** The coefficients of the stiffness, without its time factor. */
  std::vector<Expression>
  stiffness_formulas(const MaterialParameters &material);

  /** Those of the viscosity, likewise. */
  std::vector<Expression>
  viscosity_formulas(const MaterialParameters &material);

  /** Whether a property of the material depends on a variable, free strains
   * included, time factors not. */
  bool
  material_depends_on(const std::string        &variable,
                      const MaterialParameters &material);

  /** Whether the temperature causes strain, where there is one. */
  bool
  has_thermal_expansion(const MaterialParameters &material);

  /** Whether the body is isotropic, and its viscosity in proportion to its
   * stiffness. */
  bool
  creeps_in_proportion(const MaterialParameters &material);

  /** Whether K is asked for, or tried to have unasked. */
  Effects::Effect
  stress_intensity_effect(const Scene &scene, const BoundaryRoles &roles);

  /** Whether there is a change of temperature. */
  bool
  has_temperature(const LoadParameters &loads);

  /** Whether a formula can jump in time: has a condition that depends on t, or
   * on theta while the temperature may vary in time. */
  bool
  formulas_can_jump(const Scene &scene);

  /** Which of the formulas vary in time, and why: "[Material] Relaxation time
   * depends on theta"; nothing if none does. */
  std::string
  describe_variation(const std::vector<Expression> &formulas,
                     const bool                     temperature_varies);
} // namespace Crevasse

#endif
