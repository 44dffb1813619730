// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_postprocess_crack_tip_choice_h
#define crevasse_postprocess_crack_tip_choice_h

#include <crevasse/model/body.h>

#include <string>

namespace Crevasse
{
  /** How K_I is found: see interaction_integral() and WilliamsFit. */
  struct CrackTipChoice
  {
    bool        integral; ///< or the fit
    std::string why;

    /** "interaction integral" or "williams fit". */
    std::string
    name() const
    {
      return name_of(integral ? StressIntensityMethod::interaction_integral
                              : StressIntensityMethod::williams_fit);
    }
  };

  /**
   * The integral wants the displacement of an elastic body under the loads and
   * contact forces of the instant. The stress is that of such a body where
   * nothing creeps; where all points relax alike, η = τK; and where the whole
   * body is homogeneous, isotropic, and held by nothing that hinders its
   * deformation, for then its stress depends on no modulus. Thermal strain and
   * body forces would add terms of their own.
   *
   * Collective. @throw SceneError if [Crack tip] Method asks for the integral
   * where it is not right, with the reason.
   */
  CrackTipChoice
  choose_crack_tip_method(const Scene &scene, const Body<2> &body);
} // namespace Crevasse

#endif
