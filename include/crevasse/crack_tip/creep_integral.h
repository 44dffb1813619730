// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_crack_tip_creep_integral_h
#define crevasse_crack_tip_creep_integral_h

#include <crevasse/crack_tip/tip_region.h>
#include <crevasse/discretisation/stress_recovery.h>
#include <crevasse/model/body.h>

namespace Crevasse
{
  /**
   * C(t) measures the rate of creep around a crack tip by a power n of the
   * stress (Bassani, McClintock, Int. J. Solids Struct. 17, 1981):
   *
   *     C = lim ∫_Γ (W n₁ − σᵢⱼ nⱼ u̇ᵢ,₁) ds,     W = n/(n+1) σ:ε̇ᶜ,
   *
   * over curves Γ that shrink to the tip, X₁ along the crack. In steady creep C
   * is C*. With a weight q that is 1 at the tip, P = σᵢⱼ u̇ᵢ,₁ − W δ₁ⱼ and P·n
   * = 0 on open or closed lips, C is
   *
   *     C = ∫ P·∇q dA + ∫ q div P dA,
   *     div P = σ:(ε̇ − ε̇ᶜ),₁ − b·u̇,₁ − ∂W/∂X₁ at the same ε̇ᶜ,
   *
   * and does not depend on the domain: the second integral contains all strain
   * other than creep, also thermal strain, and moduli and the law may vary (on
   * the domain: Li, Shih, Needleman, 1985). Fields are recovered at nodes
   * before they are differentiated: see StressRecovery. The weight is
   * SquareWeight; a body on one side of the crack counts twice. doc/theory.md
   * adds rings.
   */
  class CreepIntegral
  {
  public:
    /** Values of C over the larger square and a square of half its size. */
    using Values = std::array<double, 2>;

    /** Collective. The arguments must outlive the CreepIntegral.
     * @throw SceneError if the cells at the tip have different materials, or
     * [Crack tip] Radius does not suit them. */
    CreepIntegral(const Scene             &scene,
                  const Body<2>           &body,
                  const CrackTip          &tip,
                  const StressRecovery<2> &recovery);

    CreepIntegral(const CreepIntegral &) = delete;

    /** Computes C. Collective. @param t within the period. @param velocity u̇,
     * in the form of displacements. */
    Values
    evaluate(const double  t,
             const Vector &stress,
             const Vector &velocity) const;

    double
    radius() const
    {
      return weights[0].radius;
    }

    const Body<2>  &body;
    const TipRegion region;

  private:
    /** Whether a cell of this rank overlaps the larger square. */
    template <typename Cell>
    bool
    is_within(const Cell &cell) const
    {
      return region.overlaps(cell->active_cell_index(), radius());
    }

    /** Derivative ∂/∂X₁ of a recovered field at all points. Collective. */
    std::vector<VoigtVector<2>>
    slopes(const Vector &field) const;

    const StressRecovery<2>                         &recovery;
    const PointGeometry                              points;
    std::vector<std::pair<unsigned int, Expression>> body_force;
    std::array<SquareWeight, 2>                      weights;
  };
} // namespace Crevasse

#endif
