// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_crack_tip_lip_integral_h
#define crevasse_crack_tip_lip_integral_h

#include <crevasse/crack_tip/auxiliary_field.h>
#include <crevasse/model/body.h>

namespace Crevasse
{
  /** Contribution ∫ 2 p q / √(2πr) ds of the pressure p on the lip to the
   * interaction integral, as factors of the contact forces of the lip's local
   * nodes. */
  std::vector<double>
  lip_integral(const Body<2>      &body,
               const CrackTip     &tip,
               const SquareWeight &weight);
} // namespace Crevasse

#endif
