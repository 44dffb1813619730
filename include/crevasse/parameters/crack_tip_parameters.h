// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_parameters_crack_tip_parameters_h
#define crevasse_parameters_crack_tip_parameters_h

#include <crevasse/base/problems.h>
#include <crevasse/parameters/selections.h>

#include <deal.II/base/parameter_handler.h>

namespace Crevasse
{
  /** What is read off at the crack tip. */
  struct CrackTipParameters
  {
    static constexpr const char *section = "Crack tip";

    bool                  stress_intensity = false;
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
  };
} // namespace Crevasse

#endif
