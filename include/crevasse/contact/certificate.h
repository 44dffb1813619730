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
   * The sizes of forces and displacements by which errors are judged. One
   * problem is solved for many right-hand sides: the largest sizes among them
   * count, so that an instant without load, where everything is rounding, is
   * not asked for relative accuracy.
   */
  struct Scales
  {
    double force        = 0.; ///< largest of |bᵢ|, |Aᵢᵢ qᵢ|
    double displacement = 0.; ///< largest of |qᵢ|, |gap|

    /** Raises the scales to those of one solution. Collective. */
    void
    include(const SignoriniProblem &problem,
            const Vector           &right_hand_side,
            const Vector           &solution);
  };

  /**
   * How well q and g = L(Aq − b) solve a Signorini problem. All four are
   * relative to Scales. 0 is exact.
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
   * @param[in,out] scales Raised to those of this solution, then used.
   * @param[out] residual A q − b off the contact dofs, zero on them.
   * @param[out] contact_forces g for each of the locally owned bounds.
   */
  Certificate
  certify(const SignoriniProblem &problem,
          const Vector           &right_hand_side,
          const Vector           &solution,
          Scales                 &scales,
          Vector                 &residual,
          std::vector<double>    &contact_forces);
} // namespace Crevasse

#endif
