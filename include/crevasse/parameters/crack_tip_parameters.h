// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_parameters_crack_tip_parameters_h
#define crevasse_parameters_crack_tip_parameters_h

#include <crevasse/base/problems.h>

#include <deal.II/base/parameter_handler.h>

#include <string>

namespace Crevasse
{
  /** What is read off at the crack tip. */
  struct CrackTipParameters
  {
    static constexpr const char *section = "Crack tip";

    bool stress_intensity = false;
    /** automatic | interaction integral | williams fit */
    std::string method = "automatic";
    /** Half the side of the square around the tip that the integral extends
     * over, or twice the radius of the smaller disc of the fit; 0: automatic.
     */
    double radius = 0.;

    /** none | paris | creep | sum */
    std::string growth_law = "none";
    // da/dN = C (ΔK − ΔK_th)^m or, without a threshold, C ΔK^m.
    double paris_factor    = 0.;
    double paris_exponent  = 3.;
    double paris_threshold = 0.;
    /** C star | stress intensity: what drives da/dt = D (...)^φ. */
    std::string creep_parameter = "C star";
    double      creep_factor    = 0.;
    double      creep_exponent  = 1.;

    /** Whether the growth law has such a part. */
    bool
    has_paris_part() const;
    bool
    has_creep_part() const;

    void
    add_parameters(dealii::ParameterHandler &prm);
    void
    check(Problems &problems) const;
  };
} // namespace Crevasse

#endif
