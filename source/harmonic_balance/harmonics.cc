// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/harmonic_balance/harmonics.h>

#include <deal.II/base/numbers.h>
#include <deal.II/lac/vector.h>

#include <algorithm>
#include <cmath>

namespace Crevasse
{
  using namespace dealii;

  Harmonics::Harmonics(const double       period,
                       const unsigned int n_instants,
                       const TimeRule     rule)
    : period(period)
    , n(n_instants)
    , rule(rule)
    , analysis(1 + 2 * n_harmonics(), n)
    , synthesis(n, 1 + 2 * n_harmonics())
  {
    for (unsigned int j = 0; j < n; ++j)
      {
        analysis(0, j)  = 1. / n;
        synthesis(j, 0) = 1.;
        for (unsigned int k = 1; k <= n_harmonics(); ++k)
          {
            // Multiples of the period are taken away before they are rounded.
            const double phase  = 2. * numbers::PI * ((j * k) % n) / n;
            const double weight = (is_real(k) ? 1. : 2.) / n;
            const double sine   = is_real(k) ? 0. : std::sin(phase);

            analysis(2 * k - 1, j)  = weight * std::cos(phase);
            analysis(2 * k, j)      = -weight * sine;
            synthesis(j, 2 * k - 1) = std::cos(phase);
            synthesis(j, 2 * k)     = -sine;
          }
      }
  }



  double
  Harmonics::instant(const unsigned int j) const
  {
    return period * j / n;
  }



  unsigned int
  Harmonics::n_harmonics() const
  {
    return n / 2;
  }



  bool
  Harmonics::is_real(const unsigned int k) const
  {
    return 2 * k == n;
  }



  std::complex<double>
  Harmonics::integral(const unsigned int k) const
  {
    if (rule == TimeRule::exact)
      return {0., -period / (2. * numbers::PI * k)};
    if (is_real(k))
      return 0.;
    return {0., -0.5 * period / n / std::tan(numbers::PI * k / n)};
  }



  template <typename VectorType>
  void
  Harmonics::apply(const FullMatrix<double> &matrix,
                   std::vector<VectorType>  &vectors)
  {
    // By blocks of entries, each of which stays in the cache.
    constexpr std::size_t block = 128;
    const std::size_t size = vectors.front().end() - vectors.front().begin();
    const std::size_t n_before = matrix.n(), n_after = matrix.m();
    vectors.resize(std::max(n_before, n_after), vectors.front());
    std::vector<double> result(n_after * block);
    for (std::size_t begin = 0; begin < size; begin += block)
      {
        const std::size_t n = std::min(block, size - begin);
        std::fill(result.begin(), result.end(), 0.);
        for (std::size_t i = 0; i < n_after; ++i)
          for (std::size_t j = 0; j < n_before; ++j)
            {
              const double  factor = matrix(i, j);
              const double *source = &*(vectors[j].begin() + begin);
              double       *target = result.data() + i * block;
              for (std::size_t k = 0; k < n; ++k)
                target[k] += factor * source[k];
            }
        for (std::size_t i = 0; i < n_after; ++i)
          std::copy_n(result.data() + i * block, n, vectors[i].begin() + begin);
      }
    vectors.resize(n_after);
  }



  template <typename VectorType>
  void
  Harmonics::analyse(std::vector<VectorType> &samples) const
  {
    apply(analysis, samples);
  }



  template <typename VectorType>
  void
  Harmonics::synthesise(std::vector<VectorType> &coefficients) const
  {
    apply(synthesis, coefficients);
  }



#define INSTANTIATE(VectorType)                                      \
  template void Harmonics::analyse(std::vector<VectorType> &) const; \
  template void Harmonics::synthesise(std::vector<VectorType> &) const

  INSTANTIATE(dealii::Vector<double>);
  INSTANTIATE(LinearAlgebra::distributed::Vector<double>);

#undef INSTANTIATE
} // namespace Crevasse
