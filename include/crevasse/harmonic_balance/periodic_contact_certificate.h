// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_harmonic_balance_periodic_contact_certificate_h
#define crevasse_harmonic_balance_periodic_contact_certificate_h

#include <crevasse/harmonic_balance/periodic_complementarity.h>

#include <string>

namespace Crevasse
{
  /**
   * How well forces, openings and offsets solve a PeriodicContactProblem. All
   * are relative: forces to the largest one, openings to the largest one
   * without contact (and without its mean in time) plus what the largest force
   * does by itself. 0 is exact.
   */
  struct PeriodicContactCertificate
  {
    double penetration     = 0.; ///< largest −w
    double tension         = 0.; ///< largest −g
    double complementarity = 0.; ///< largest |g w|
    double mean_defect     = 0.; ///< largest |mean(g) − ḡ|
    double residual        = 0.; ///< largest |w − w⁰ − S ∗ g − c|

    /** The largest of the five; infinite if one is not a number. */
    double
    worst() const;

    /** All five with their names. */
    std::string
    describe() const;
  };

  /** Certifies a state at the cost of one convolution. */
  PeriodicContactCertificate
  certify(const PeriodicComplementarity &problem, const PeriodicState &state);
} // namespace Crevasse

#endif
