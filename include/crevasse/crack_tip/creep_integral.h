// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_crack_tip_creep_integral_h
#define crevasse_crack_tip_creep_integral_h

#include <crevasse/crack_tip/front_region.h>
#include <crevasse/crack_tip/tip_region.h>
#include <crevasse/discretisation/stress_recovery.h>
#include <crevasse/model/body.h>

#include <type_traits>

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
   * before they are differentiated: see StressRecovery. The weight Q is
   * SquareWeight; a body on one side of the crack counts twice.
   *
   * Along a front with the curvature k, metric g = 1 + kX and tangent t, C at a
   * vertex follows from its hat function h(s), with P the tensor σᵢⱼ u̇ᵢ,ₖ − W
   * δₖⱼ, as the front moves by q = h Q ahead (Shih, Moran, Nakamura, 1986):
   *
   *     ∫ C h ds = ∫ P₁·∇q dV + ∫ q (div P₁ + k/g t·P·t) dV.
   *
   * In a body of revolution the front is a circle.
   */
  template <int dim>
  class CreepIntegral
  {
  public:
    /** Surroundings of a tip, or of all fronts in space. */
    using Region = std::conditional_t<dim == 2, TipRegion, FrontRegion>;

    /** Values of C over the larger square and a square of half its size. */
    using Values = std::array<double, 2>;

    /** Collective. Copies the region; the other arguments must outlive the
     * CreepIntegral.
     * @throw SceneError if the cells at the tip or front have different
     * materials, or [Crack tip] Radius does not suit them. */
    CreepIntegral(const Scene               &scene,
                  const Body<dim>           &body,
                  const Region              &region,
                  const StressRecovery<dim> &recovery);

    CreepIntegral(const CreepIntegral &) = delete;

    /** Computes C at the tip, or at each vertex of the fronts. Collective.
     * @param t within the period.
     * @param velocity u̇, in the form of displacements. */
    std::vector<Values>
    evaluate(const double  t,
             const Vector &stress,
             const Vector &velocity) const;

    /** Number of these values. */
    unsigned int
    n_values() const
    {
      if constexpr (dim == 2)
        return 1;
      else
        return region.vertices.size();
    }

    double
    radius() const
    {
      return weights[0].radius;
    }

    /** "crack tip (x, y)" or "crack front". */
    std::string
    name() const;

    /** Describes the squares in one line for the log. */
    std::string
    describe() const;

    const Body<dim> &body;
    const Region     region;

  private:
    /** Quadrature point in the larger square. */
    struct Place
    {
      std::size_t                     point;
      double                          weight; ///< JxW
      dealii::Point<dim>              location;
      FrontFrame                      frame;
      std::array<FrontRegion::Hat, 2> hats; ///< at a tip the first is 1
    };

    /** Whether a cell of this rank may overlap the larger square. */
    template <typename Cell>
    bool
    is_within(const Cell &cell) const;

    void
    find_places();

    /** Derivative ∂/∂X₁ of a recovered field at all points of cells that
     * overlap the larger square. Collective. */
    std::vector<VoigtVector<dim>>
    slopes(const Vector &field) const;

    /** P and div P₁ at an instant. */
    struct State
    {
      dealii::Tensor<2, 3> P;
      double               divergence;
    };

    /** Adds the share of a place to the values of its tip or vertices. */
    void
    add(const Place         &place,
        const State         &state,
        std::vector<Values> &sums) const;

    /** Values of C of sums over the places of all ranks. */
    void
    normalise(std::vector<Values> &sums) const;

    const StressRecovery<dim>                       &recovery;
    std::vector<std::pair<unsigned int, Expression>> body_force;
    std::array<SquareWeight, 2>                      weights;
    std::vector<Place> places; ///< ascending points
    /** Direction of X₁ at this rank's points; 0 outside of the square. */
    std::vector<dealii::Tensor<1, dim>> ahead;
  };
} // namespace Crevasse

#endif
