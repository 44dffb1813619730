// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_parameters_effects_h
#define crevasse_parameters_effects_h

#include <crevasse/parameters/boundary_roles.h>
#include <crevasse/parameters/scene.h>

namespace Crevasse
{
  /** Active and inactive effects of a scene, decided once, with reasons. An
   * inactive effect is not created: it costs neither time nor memory. */
  struct Effects
  {
    struct Effect
    {
      std::string name;
      bool        on = false;
      std::string why;
    };

    Effect contact;
    Effect friction; ///< Coulomb's friction between lips
    Effect viscosity;
    Effect secular_flow; ///< secular flow, once loads are known
    Effect chain;
    /** Whether each of MaterialParameters::free_strains() is on. */
    std::vector<Effect> free_strains;
    Effect              varying_stiffness; ///< stiffness that varies in time
    Effect              varying_viscosity;
    /** Whether each of LoadParameters::forces() that acts in the volume is
     * on. */
    std::vector<Effect> volume_forces;
    Effect              imposed_displacement;
    Effect              singular_functions;
    Effect              stress_intensity;
    Effect              field_output;

    /** @param temperature_varies Whether [Loads] Temperature varies in time. */
    Effects(const Scene         &scene,
            const BoundaryRoles &roles,
            const bool           temperature_varies);

    /** First effect in a list that is on, or nullptr. */
    static const Effect *
    first_on(const std::vector<Effect> &effects);

    /** All effects in a fixed order, for tables. */
    std::vector<Effect>
    list() const;
  };

  // Dependences of the formulas that a scene uses. The scene must have passed
  // its check.

  /** Formulas of the stiffness coefficients, without the time factor. */
  std::vector<Expression>
  stiffness_formulas(const MaterialParameters &material);

  /** Formulas of the viscosity coefficients, without the time factor. */
  std::vector<Expression>
  viscosity_formulas(const MaterialParameters &material);

  /** Formulas of stiffness, viscosity and free strains. */
  std::vector<Expression>
  material_formulas(const MaterialParameters &material);

  /** Whether a property of the material, or a free strain, depends on a
   * variable; time factors do not count. */
  bool
  material_depends_on(const std::string        &variable,
                      const MaterialParameters &material);

  /** Whether the coefficient of thermal expansion is not zero. */
  bool
  has_thermal_expansion(const MaterialParameters &material);

  /** Whether the body is isotropic, and its viscosity proportional to its
   * stiffness. */
  bool
  creeps_in_proportion(const MaterialParameters &material);

  /** Whether K is computed: on request, or automatically if possible. */
  Effects::Effect
  stress_intensity_effect(const Scene &scene, const BoundaryRoles &roles);

  /** Whether the loads have a change of temperature. */
  bool
  has_temperature(const LoadParameters &loads);

  /** Whether a formula can jump in time: has a condition that depends on t, or
   * on theta while the temperature may vary in time. */
  bool
  formulas_can_jump(const Scene &scene);
} // namespace Crevasse

#endif
