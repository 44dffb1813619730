// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_parameters_crack_tip_parameters_h
#define crevasse_parameters_crack_tip_parameters_h

#include <crevasse/base/problems.h>
#include <crevasse/parameters/formulas.h>
#include <crevasse/parameters/growth_table.h>
#include <crevasse/parameters/selections.h>

#include <deal.II/base/parameter_handler.h>

#include <memory>

namespace Crevasse
{
  /** Constants of a growth law at a temperature. */
  struct GrowthConstants
  {
    // Paris law: da/dN = C (ΔK − ΔK_th)^m or, without a threshold, C ΔK^m.
    double paris_factor;
    double paris_exponent;
    double paris_threshold;
    // Factors of Walker's law; see growth_over_period().
    double walker_exponent;
    double threshold_exponent;
    double toughness; ///< K_c; 0: not known
    double toughness_exponent;
    // Growth by creep, da/dt = D P^φ.
    double creep_factor;
    double creep_exponent;
  };

  /** Parameters of section Crack tip: stress intensity and growth laws. */
  struct CrackTipParameters : FormulaParsers
  {
    static constexpr const char *section = "Crack tip";

    StressIntensityChoice stress_intensity = StressIntensityChoice::automatic;
    bool                  creep_integral   = false;
    StressIntensityMethod method           = StressIntensityMethod::automatic;
    /** Half the side of the square of the integral around the tip, or twice the
     * radius of the smaller disc of the fit; 0: automatic. */
    double radius = 0.;

    GrowthLawType growth_law   = GrowthLawType::none;
    GrowthRange   growth_range = GrowthRange::whole;
    // Formulas of the GrowthConstants.
    Formula paris_factor    = constant("Paris factor", "0");
    Formula paris_exponent  = constant("Paris exponent", "3", Ranges::positive);
    Formula paris_threshold = constant("Paris threshold", "0");
    Formula walker_exponent = constant("Walker exponent", "1");
    Formula threshold_exponent = constant("Threshold exponent", "0");
    Formula toughness          = constant("Fracture toughness", "0");
    Formula toughness_exponent = constant("Toughness exponent", "0");
    Formula creep_factor       = constant("Creep factor", "0");
    Formula creep_exponent = constant("Creep exponent", "1", Ranges::positive);
    /** File with da/dN(ΔK, R), and its content where a law needs it. */
    std::string                        growth_table = {};
    std::shared_ptr<const GrowthTable> table        = nullptr;
    /** Quantity P that drives creep growth, da/dt = D P^φ. */
    CreepParameter creep_parameter = CreepParameter::C_star;

    void
    add_parameters(dealii::ParameterHandler &prm);
    void
    check(Problems &problems) const;

    /** Reads the growth table if the law needs it. */
    void
    read_table(Problems &problems);

    /** Constants at a temperature. @throw SceneError if one is out of its
     * range. */
    GrowthConstants
    constants(const double temperature) const;

    /** Whether a constant depends on the temperature. */
    bool
    depend_on_temperature() const;

    /** Whether C(t) drives the growth. */
    bool
    grows_by_C_of_t() const;

    /** Whether K is requested, by itself or for the growth. */
    bool
    needs_stress_intensity() const;

    /** Whether K is required: requested, or its radius or method is given. */
    bool
    demands_stress_intensity() const
    {
      return needs_stress_intensity() || radius > 0. ||
             method != StressIntensityMethod::automatic;
    }

  private:
    Formula
    constant(const std::string &name,
             const std::string &usual,
             const Range       &range = Ranges::not_negative) const
    {
      return {usual, growth_constant(name, range)};
    }
  };

  /** A constant of growth laws: its parameter, formula, value and range. */
  struct GrowthConstant
  {
    const char *name;
    Formula CrackTipParameters::*formula;
    double GrowthConstants::*value;
    Range                    range = Ranges::not_negative;
  };

  constexpr GrowthConstant growth_constants[] = {
    {"Paris factor",
     &CrackTipParameters::paris_factor,
     &GrowthConstants::paris_factor},
    {"Paris exponent",
     &CrackTipParameters::paris_exponent,
     &GrowthConstants::paris_exponent,
     Ranges::positive},
    {"Paris threshold",
     &CrackTipParameters::paris_threshold,
     &GrowthConstants::paris_threshold},
    {"Walker exponent",
     &CrackTipParameters::walker_exponent,
     &GrowthConstants::walker_exponent},
    {"Threshold exponent",
     &CrackTipParameters::threshold_exponent,
     &GrowthConstants::threshold_exponent},
    {"Fracture toughness",
     &CrackTipParameters::toughness,
     &GrowthConstants::toughness},
    {"Toughness exponent",
     &CrackTipParameters::toughness_exponent,
     &GrowthConstants::toughness_exponent},
    {"Creep factor",
     &CrackTipParameters::creep_factor,
     &GrowthConstants::creep_factor},
    {"Creep exponent",
     &CrackTipParameters::creep_exponent,
     &GrowthConstants::creep_exponent,
     Ranges::positive}};
} // namespace Crevasse

#endif
