// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_harmonic_balance_periodic_state_h
#define crevasse_harmonic_balance_periodic_state_h

#include <crevasse/harmonic_balance/periodic_convolution.h>

namespace Crevasse
{
  /** Forces and offsets of a PeriodicContactProblem, and the resulting
   * openings. A function of time is a vector of p N entries, all nodes of the
   * first instant first. */
  struct PeriodicState
  {
    /** Creates the zero state. The arguments must outlive it. */
    PeriodicState(const PeriodicContactProblem &problem,
                  const PeriodicConvolution    &convolution);

    /** Computes w = w⁰ + S ∗ g + c, plus the proximal term. */
    void
    compute_openings();

    /** Scale of forces: the largest |g|, or ḡ if larger; without any, one that
     * moves nodes as far as they are without contact, or 1. */
    double
    force_scale() const
    {
      const double opening = without_contact.linfty_norm();
      const double largest =
        std::max(forces.linfty_norm(), mean_forces.linfty_norm());
      return largest > 0.   ? largest
             : opening > 0. ? opening / convolution.largest_compliance
                            : 1.;
    }

    /** Scale of openings: largest |w⁰| plus effect of the largest force. */
    double
    opening_scale() const
    {
      return without_contact.linfty_norm() +
             convolution.largest_compliance * force_scale();
    }

    /** Given means of the forces minus their current means. */
    LipVector
    missing_means() const;

    PeriodicContactCertificate
    certify() const;

    LipVector forces, openings, offsets;

    /** Proximal term: shift × (forces − centre) is added to the openings. */
    double    shift = 0.;
    LipVector centre;

    const PeriodicConvolution &convolution;
    const LipVector            without_contact; ///< openings w⁰
    const LipVector           &mean_forces;
  };
} // namespace Crevasse

#endif
