// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_parameters_crack_tip_parameters_h
#define crevasse_parameters_crack_tip_parameters_h

#include <crevasse/base/problems.h>
#include <crevasse/parameters/growth_table.h>
#include <crevasse/parameters/selections.h>

#include <deal.II/base/parameter_handler.h>

#include <memory>

namespace Crevasse
{
  /** Parameters of section Crack tip: stress intensity and growth laws. */
  struct CrackTipParameters
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
    // Paris law: da/dN = C (ΔK − ΔK_th)^m or, without a threshold, C ΔK^m.
    double paris_factor    = 0.;
    double paris_exponent  = 3.;
    double paris_threshold = 0.;
    // Factors of Walker's law; see growth_over_period().
    double walker_exponent    = 1.;
    double threshold_exponent = 0.;
    double toughness          = 0.; ///< K_c; 0: not known
    double toughness_exponent = 0.;
    /** File with da/dN(ΔK, R), and its content where a law needs it. */
    std::string                        growth_table;
    std::shared_ptr<const GrowthTable> table;
    /** Quantity P that drives creep growth, da/dt = D P^φ. */
    CreepParameter creep_parameter = CreepParameter::C_star;
    double         creep_factor    = 0.;
    double         creep_exponent  = 1.;

    void
    add_parameters(dealii::ParameterHandler &prm);
    void
    check(Problems &problems) const;

    /** Reads the growth table if the law needs it. */
    void
    read_table(Problems &problems);

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
  };
} // namespace Crevasse

#endif
