// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_postprocess_tip_errors_h
#define crevasse_postprocess_tip_errors_h

#include <crevasse/postprocess/crack_tip_analysis.h>

namespace Crevasse
{
  /** Errors at a tip by the mesh. */
  struct MeshErrors
  {
    /** Errors of K_I and K_II, relative to √(K_I² + K_II²). */
    std::array<double, 2> of_intensity{};
    /** Error of T at the extreme loads; closed tips have a T without K. */
    double of_T = 0.;
  };

  /**
   * Estimates the errors of K_I, K_II and T at each tip, for the elastic body
   * at the extreme loads; at least those of fields of known K. Collective.
   *
   * K is a linear function of the stress, ∫ s:N. Its dual state is that of the
   * body under the strain N without stress and no load, where lips stay as they
   * are: the error of K is the product of the errors of both stresses, in the
   * norm of their elastic energy (Becker and Rannacher, Acta Numerica 10,
   * 2001). Each cell counts with the product of what StressEstimator finds of
   * both.
   */
  std::vector<MeshErrors>
  mesh_errors_of_tips(
    const Scene                                                &scene,
    const Body<2>                                              &body,
    ContactSystemCache<2>                                      &systems,
    const StepList                                             &steps,
    const std::vector<std::unique_ptr<const CrackTipAnalysis>> &tips);
} // namespace Crevasse

#endif
