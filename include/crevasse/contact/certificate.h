// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_contact_certificate_h
#define crevasse_contact_certificate_h

#include <crevasse/contact/signorini_problem.h>
#include <crevasse/lip/contact_forces.h>

#include <limits>
#include <string>

namespace Crevasse
{
  /**
   * Scales of forces and displacements, relative to which errors are measured.
   * One problem is solved for many right-hand sides: the largest sizes among
   * them count, so that an instant without load, where everything is rounding,
   * needs no relative accuracy.
   *
   * A body that creeps for many periods has a displacement, and a right-hand
   * side with its viscous strain, far larger than those caused by the loads of
   * a period. If the loads are set, they alone are the scale.
   */
  class Scales
  {
  public:
    /** Sets the largest nodal force of the loads; 0: unknown. */
    void
    set_force_scale(const double largest_nodal_force)
    {
      load = largest_nodal_force;
    }

    /** Includes a solution in the maxima of the scales. Collective. */
    void
    include(const SignoriniProblem &problem,
            const Vector           &right_hand_side,
            const Vector           &solution);

    /** Scale of forces; 1 if nothing was loaded or moved: any is right. */
    double
    force() const;
    double
    displacement() const
    {
      return largest_displacement > 0. ? largest_displacement : 1.;
    }

    /** Accuracy of forces that rounding allows, relative to force(): sums of
     * Aᵢⱼqⱼ cancel, the more, the finer the mesh and the longer the drift. */
    double
    force_rounding() const
    {
      return some_roundings * force_to_round / force();
    }

    /** Relative accuracy of displacements that rounding allows. */
    double
    displacement_rounding() const
    {
      return some_roundings * displacement_to_round / displacement();
    }

  private:
    static constexpr double some_roundings =
      100. * std::numeric_limits<double>::epsilon();

    double load                  = 0.; ///< largest nodal force, if known
    double largest_force         = 0.; ///< largest |bᵢ|
    double largest_displacement  = 0.; ///< largest |qᵢ|, without a long drift
    double force_to_round        = 0.; ///< largest |Aᵢᵢqᵢ|
    double displacement_to_round = 0.; ///< largest |qᵢ|
  };

  /**
   * Errors of q and g = L(Aq − b) as a solution of a Signorini problem,
   * relative to Scales; 0 is exact.
   */
  struct Certificate
  {
    double penetration     = 0.; ///< penetration: max(gap − Lq)
    double tension         = 0.; ///< tension: max(−g)
    double complementarity = 0.; ///< max min(|g|, |Lq − gap|)
    double residual        = 0.; ///< max |Aq − b| off the lip
    /** Friction: max |g_T − P(g_T − δ)| with the slip δ and the projection P on
     * forces of at most μg. */
    double friction = 0.;
    /** Largest residual of Newton's method (nonlinear creep), relative to the
     * forces. */
    double newton_residual = 0.;

    /** Largest of the first five errors. */
    double
    worst() const;

    /** Keeps the larger value of each error, for the maxima over a run. */
    void
    merge(const Certificate &other);

    std::string
    describe() const;
  };

  /** A right-hand side b, what friction needs to know unless there is none,
   * and a candidate for the solution q. */
  struct Candidate
  {
    const Vector        &right_hand_side;
    const Vector        &solution;
    const FrictionState *friction = nullptr;
  };

  /**
   * Certifies a solution at the cost of one matrix–vector product.
   *
   * @param[in,out] scales Raised to those of this solution, then used.
   * @param[out] residual A q − b off the contact dofs, zero on them.
   * @param[out] contact_forces of each locally owned bound.
   */
  Certificate
  certify(const SignoriniProblem &problem,
          const Candidate        &candidate,
          Scales                 &scales,
          Vector                 &residual,
          ContactForces          &contact_forces);
} // namespace Crevasse

#endif
