// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_harmonic_balance_harmonics_h
#define crevasse_harmonic_balance_harmonics_h

#include <crevasse/parameters/solver_selections.h>

#include <deal.II/lac/full_matrix.h>

#include <algorithm>
#include <complex>
#include <vector>

namespace Crevasse
{
  /**
   * A period sampled at N equidistant instants t_j, and the trigonometric
   * polynomial through the samples,
   *
   *     x(t_j) = Re Σₙ cₙ exp(iωₙt_j),   n = 0 … N/2,   ωₙ = 2πn/T.
   *
   * If N is even, the sine of the last harmonic vanishes at all instants: only
   * the real parts of its coefficient and of a response to it count, with
   * either rule.
   */
  class Harmonics
  {
  public:
    /** @param rule replaces the time derivative of a harmonic. trapezoid: by
     * that of the trapezoidal rule with steps from instant to instant, so that
     * the samples satisfy this scheme to rounding. exact: by the derivative of
     * the trigonometric polynomial, as accurate as the loads are smooth. */
    Harmonics(const double       period,
              const unsigned int n_instants,
              const HarmonicRule rule);

    double
    instant(const unsigned int j) const
    {
      return period * j / n_instants;
    }

    /** Number of harmonics without the mean: N/2, rounded down. */
    unsigned int
    n_harmonics() const
    {
      return n_instants / 2;
    }

    /** Whether the samples show only the real part of harmonic @p n. */
    bool
    is_real(const unsigned int n) const
    {
      return 2 * n == n_instants;
    }

    /** Factor 1/zₙ of harmonic n > 0 for an integral in time: zₙ = iωₙ with the
     * exact rule, (2i/Δt) tan(ωₙΔt/2) with the trapezoidal one, which is
     * infinite for the last harmonic of an even N. */
    std::complex<double>
    integral(const unsigned int n) const;

    /**
     * Replaces N samples by coefficients: the mean c₀, then real and imaginary
     * part of each cₙ, at the indices 2n − 1 and 2n.
     *
     * @tparam VectorType a vector whose local entries are contiguous.
     */
    template <typename VectorType>
    void
    analyse(std::vector<VectorType> &samples) const
    {
      apply(analysis, samples);
    }

    /** Replaces coefficients by N samples, the inverse of analyse(). */
    template <typename VectorType>
    void
    synthesise(std::vector<VectorType> &coefficients) const
    {
      apply(synthesis, coefficients);
    }

    /** Coefficients of the function 0: copies of @p model, a zero vector. */
    template <typename VectorType>
    std::vector<VectorType>
    zero(const VectorType &model) const
    {
      return std::vector<VectorType>(1 + 2 * n_harmonics(), model);
    }

    const unsigned int n_instants; ///< number N of instants

  private:
    /** Replaces vectors by linear combinations, by the rows of a matrix. */
    template <typename VectorType>
    static void
    apply(const dealii::FullMatrix<double> &matrix,
          std::vector<VectorType>          &vectors);

    const double               period;
    const HarmonicRule         rule;
    dealii::FullMatrix<double> analysis, synthesis;
  };



  template <typename VectorType>
  void
  Harmonics::apply(const dealii::FullMatrix<double> &matrix,
                   std::vector<VectorType>          &vectors)
  {
    // Entries are treated in blocks that stay in the cache.
    constexpr std::size_t block = 128;
    const std::size_t size = vectors.front().end() - vectors.front().begin();
    vectors.resize(std::max(matrix.n(), matrix.m()), vectors.front());
    dealii::FullMatrix<double> before(matrix.n(), block),
      after(matrix.m(), block);
    for (std::size_t begin = 0; begin < size; begin += block)
      {
        const std::size_t n = std::min(block, size - begin);
        for (unsigned int i = 0; i < matrix.n(); ++i)
          std::copy_n(vectors[i].begin() + begin, n, &before(i, 0));
        matrix.mmult(after, before);
        for (unsigned int i = 0; i < matrix.m(); ++i)
          std::copy_n(&after(i, 0), n, vectors[i].begin() + begin);
      }
    vectors.resize(matrix.m());
  }
} // namespace Crevasse

#endif
