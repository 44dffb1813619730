// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_discretisation_polar_field_h
#define crevasse_discretisation_polar_field_h

#include <crevasse/grid/crack_tip.h>

#include <array>

namespace Crevasse
{
  /**
   * A displacement of mode I or II around a crack tip, in the tip's coordinates
   * (X ahead, Y into the body; see CrackTip), with δ = 0 or π/2:
   *
   *     u_X = r^p Σ aᵢ cos(mᵢθ − δ),      u_Y = r^p Σ bᵢ sin(mᵢθ − δ)
   *
   * Its gradient is singular at the tip for p < 1; do not evaluate it there.
   */
  class PolarField
  {
  public:
    /** Term of the sums: mᵢ, aᵢ, bᵢ. */
    struct Term
    {
      double frequency, cosine, sine;
    };

    PolarField(const double               power,
               const CrackMode            mode,
               const std::array<Term, 2> &terms)
      : power(power)
      , phase(mode == CrackMode::sliding ? dealii::numbers::PI_2 : 0.)
      , terms(terms)
    {
    }

    dealii::Tensor<1, 2>
    displacement(const dealii::Point<2> &local) const;

    /** Gradient ∂u_i/∂X_j. */
    dealii::Tensor<2, 2>
    gradient(const dealii::Point<2> &local) const;

    PolarField &
    operator*=(const double factor)
    {
      for (Term &term : terms)
        {
          term.cosine *= factor;
          term.sine *= factor;
        }
      return *this;
    }

  private:
    double              power, phase;
    std::array<Term, 2> terms;
  };

  /**
   * The n-th term of the series of Williams (J. Appl. Mech. 24, 1957) for a
   * crack with free lips, n ≥ 1, as 2μu:
   *
   *     2μ u_X = r^{n/2} [(κ + n/2 + (−1)ⁿ) cos(nθ/2) − (n/2) cos((n/2 − 2)θ)]
   *     2μ u_Y = r^{n/2} [(κ − n/2 − (−1)ⁿ) sin(nθ/2) + (n/2) sin((n/2 − 2)θ)]
   *
   * and in mode II with −(−1)ⁿ and δ = π/2. The first term has K = √(2π), the
   * second one is the stress along the crack; even terms of mode I and all
   * terms of mode II do not open the crack.
   *
   * @param kappa 3 − 4ν in plane strain, (3 − ν)/(1 + ν) in plane stress.
   */
  PolarField
  williams_term(const unsigned int n,
                const double       kappa,
                const CrackMode    mode = CrackMode::opening);

  /** Displacement D with √r that spans, with the first term of the series, the
   * terms with √r for all κ: in mode I √r (cos θ/2 (1 + cos θ), sin θ/2 (1 +
   * cos θ)). The lips do not move apart. */
  PolarField
  square_root_without_jump(const CrackMode mode = CrackMode::opening);
} // namespace Crevasse

#endif
