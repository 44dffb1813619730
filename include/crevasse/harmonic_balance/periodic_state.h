// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_harmonic_balance_periodic_state_h
#define crevasse_harmonic_balance_periodic_state_h

#include <crevasse/harmonic_balance/periodic_convolution.h>

namespace Crevasse
{
  /** Forces and offsets of a PeriodicContactProblem, and the openings that they
   * leave. Functions of time are one vector of p N entries, all nodes of the
   * first instant first. */
  struct PeriodicState
  {
    /** All zero. Keeps references. */
    PeriodicState(const PeriodicContactProblem &problem,
                  const PeriodicConvolution    &convolution);

    /** w = w⁰ + S ∗ g + c, and the proximal term. */
    void
    compute_openings();

    /** The largest |g|, and no less than the largest mean. */
    double
    force_scale() const
    {
      return std::max(forces.linfty_norm(), mean_forces.linfty_norm());
    }

    /** The largest |w⁰|, plus what the largest force does by itself. */
    double
    opening_scale() const
    {
      return without_contact.linfty_norm() +
             convolution.largest_compliance * force_scale();
    }

    /** What the mean of the forces lacks. */
    LipVector
    missing_means() const;

    PeriodicContactCertificate
    certify() const;

    LipVector forces, openings, offsets;

    /** Of proximal points: what multiplies forces less those of the centre, for
     * an opening. */
    double    shift = 0.;
    LipVector centre;

    const PeriodicConvolution &convolution;
    const LipVector            without_contact; ///< w⁰
    const LipVector           &mean_forces;
  };
} // namespace Crevasse

#endif
