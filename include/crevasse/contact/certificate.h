// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_contact_certificate_h
#define crevasse_contact_certificate_h

#include <crevasse/contact/signorini_problem.h>

#include <limits>
#include <string>

namespace Crevasse
{
  /**
   * The sizes of forces and displacements by which errors are judged. One
   * problem is solved for many right-hand sides: the largest sizes among them
   * count, so that an instant without load, where everything is rounding, is
   * not asked for relative accuracy.
   *
   * A body that creeps on for many periods has a displacement, and a
   * right-hand side that holds its viscous strain, far larger than what one
   * period's loads do. If the loads are made known, they alone are the scale.
   */
  class Scales
  {
  public:
    /** Makes the largest nodal force of the loads known, if not 0. */
    void
    set_force_scale(const double largest_nodal_force)
    {
      load = largest_nodal_force;
    }

    /** Raises the scales to those of one solution. Collective. */
    void
    include(const SignoriniProblem &problem,
            const Vector           &right_hand_side,
            const Vector           &solution);

    /** 1 where nothing was ever loaded or moved: then any scale will do. */
    double
    force() const;
    double
    displacement() const
    {
      return largest_displacement > 0. ? largest_displacement : 1.;
    }

    /** The accuracy that rounding allows, relative to force(): sums of Aᵢⱼqⱼ
     * cancel, all the more the finer the mesh and the longer the drift. */
    double
    force_rounding() const
    {
      return some_roundings * force_to_round / force();
    }

    /** The same, relative to displacement(). */
    double
    displacement_rounding() const
    {
      return some_roundings * displacement_to_round / displacement();
    }

  private:
    static constexpr double some_roundings =
      100. * std::numeric_limits<double>::epsilon();

    double load                  = 0.; ///< the largest nodal force, if known
    double largest_force         = 0.; ///< of |bᵢ|
    double largest_displacement  = 0.; ///< of |qᵢ|, without a long drift
    double force_to_round        = 0.; ///< of |Aᵢᵢqᵢ|
    double displacement_to_round = 0.; ///< of |qᵢ|
  };

  /**
   * How well q and g = L(Aq − b) solve a Signorini problem. All are relative to
   * Scales. 0 is exact.
   */
  struct Certificate
  {
    double penetration     = 0.; ///< largest gap − Lq
    double tension         = 0.; ///< largest −g
    double complementarity = 0.; ///< largest min(|g|, |Lq − gap|)
    double residual        = 0.; ///< largest |Aq − b| off the lip
    /** Largest residual of Newton's method (power laws), relative to the
     * forces. */
    double newton_residual = 0.;

    /** The largest of the first four. */
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
