// ---------------------------------------------------------------------
//
// Copyright (C) 2026 by the Crevasse authors
//
// This file is part of Crevasse. It is free software; you can use it,
// redistribute it and/or modify it under the terms of the GNU Lesser
// General Public License as published by the Free Software Foundation;
// either version 2.1 of the License, or (at your option) any later version.
//
// ---------------------------------------------------------------------

#ifndef crevasse_contact_certificate_h
#define crevasse_contact_certificate_h

#include <crevasse/contact/signorini_problem.h>

#include <string>
#include <vector>

namespace Crevasse
{
  /**
   * How well q and g = L(Aq − b) solve a Signorini problem. All four are
   * scaled by the problem's own sizes: forces by max(|bᵢ|, |Aᵢᵢ qᵢ|),
   * displacements by max(|qᵢ|, |gap|). 0 is exact.
   */
  struct Certificate
  {
    double penetration     = 0.; ///< largest gap − Lq
    double tension         = 0.; ///< largest −g
    double complementarity = 0.; ///< largest min(|g|, |Lq − gap|)
    double residual        = 0.; ///< largest |Aq − b| off the lip

    /** The largest of the four. */
    double
    worst() const;

    /** Keeps the larger of each, for the maxima over a run. */
    void
    merge(const Certificate &other);

    std::string
    describe() const;
  };

  /**
   * Certifies a solution at the cost of one matrix–vector product.
   *
   * @param[out] residual A q − b off the contact dofs, zero on them.
   * @param[out] contact_forces g for each of the locally owned bounds.
   */
  Certificate
  certify(const SignoriniProblem &problem,
          const Vector           &right_hand_side,
          const Vector           &solution,
          Vector                 &residual,
          std::vector<double>    &contact_forces);
} // namespace Crevasse

#endif
