// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/harmonic_balance/periodic_convolution.h>

#include <deal.II/base/exceptions.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <fftw3.h>

namespace Crevasse
{
  using namespace dealii;

  namespace
  {
    using Complex = std::complex<double>;
  } // namespace



  /** N reals and N/2 + 1 complex numbers for each of many functions that are
   * interleaved, with both transforms between them. */
  struct PeriodicConvolution::Transforms
  {
    Transforms(const unsigned int N, const unsigned int n_functions)
      : values(static_cast<std::size_t>(N) * n_functions)
      , harmonics(static_cast<std::size_t>(N / 2 + 1) * n_functions)
    {
      const int  length    = N;
      const int  stride    = n_functions;
      const auto complexes = reinterpret_cast<fftw_complex *>(harmonics.data());
      // Estimated plans do not depend on how busy the machine was.
      forward  = fftw_plan_many_dft_r2c(1,
                                       &length,
                                       stride,
                                       values.data(),
                                       nullptr,
                                       stride,
                                       1,
                                       complexes,
                                       nullptr,
                                       stride,
                                       1,
                                       FFTW_ESTIMATE);
      backward = fftw_plan_many_dft_c2r(1,
                                        &length,
                                        stride,
                                        complexes,
                                        nullptr,
                                        stride,
                                        1,
                                        values.data(),
                                        nullptr,
                                        stride,
                                        1,
                                        FFTW_ESTIMATE);
      AssertThrow(forward != nullptr && backward != nullptr,
                  ExcMessage("FFTW made no plan."));
    }

    ~Transforms()
    {
      fftw_destroy_plan(forward);
      fftw_destroy_plan(backward);
    }

    Transforms(const Transforms &) = delete;
    Transforms &
    operator=(const Transforms &) = delete;

    std::vector<double>  values;
    std::vector<Complex> harmonics;
    fftw_plan            forward;
    fftw_plan            backward;
  };



  PeriodicConvolution::PeriodicConvolution(
    const std::vector<PeriodicContactProblem::Compliance> &compliances,
    const unsigned int                                     n_nodes,
    const unsigned int                                     n_instants)
    : compliances(compliances)
    , p(n_nodes)
    , N(n_instants)
    , transforms(std::make_unique<Transforms>(n_instants, n_nodes))
  {
    AssertDimension(compliances.size(), N / 2);
    for (const auto &[matrix, factor] : compliances)
      {
        AssertDimension(matrix->m(), p);
        AssertDimension(matrix->n(), p);
        AssertThrow(std::isfinite(std::abs(factor) * matrix->frobenius_norm()),
                    ExcMessage("A compliance is not finite."));
        for (unsigned int i = 0; i < p; ++i)
          largest = std::max(largest, std::abs(factor * (*matrix)(i, i)));
      }
    if (compliances.empty())
      return;
    elastic.reinit(p, p);
    const auto &[matrix, factor] = compliances.back();
    for (unsigned int i = 0; i < p; ++i)
      for (unsigned int j = 0; j < p; ++j)
        elastic(i, j) =
          0.5 * std::real(factor * ((*matrix)(i, j) + (*matrix)(j, i)));
  }



  PeriodicConvolution::~PeriodicConvolution() = default;



  void
  PeriodicConvolution::vmult(dealii::Vector<double>       &result,
                             const dealii::Vector<double> &function) const
  {
    AssertDimension(function.size(), p * N);
    std::copy(function.begin(), function.end(), transforms->values.begin());
    fftw_execute(transforms->forward);

    std::fill_n(transforms->harmonics.begin(), p, Complex(0.));
    dealii::Vector<Complex> before(p), after(p);
    for (unsigned int n = 1; n <= N / 2; ++n)
      {
        const auto &[matrix, factor] = compliances[n - 1];
        const auto harmonic          = transforms->harmonics.begin() + n * p;
        std::copy_n(harmonic, p, before.begin());
        matrix->vmult(after, before);
        // The transforms do not divide by N. The last harmonic of an even N
        // is real, and so is what the transform back takes of it.
        for (unsigned int i = 0; i < p; ++i)
          harmonic[i] = after(i) * (factor / static_cast<double>(N));
      }
    fftw_execute(transforms->backward);
    result.reinit(p * N, true);
    std::copy(transforms->values.begin(),
              transforms->values.end(),
              result.begin());
  }



  std::vector<FullMatrix<double>>
  PeriodicConvolution::definite_kernel() const
  {
    const std::size_t n_entries = std::size_t(p) * p;
    Transforms        entries(N, n_entries);
    const auto        at = [&](const unsigned int n, const unsigned int i) {
      return entries.harmonics.begin() + n * n_entries + i * p;
    };
    for (unsigned int i = 0; i < p; ++i)
      for (unsigned int j = 0; j < p; ++j)
        {
          at(0, i)[j] = N > 1 ? elastic(i, j) / N : 0.;
          for (unsigned int n = 1; n <= N / 2; ++n)
            at(n, i)[j] = compliances[n - 1].factor / static_cast<double>(N) *
                          (*compliances[n - 1].matrix)(i, j);
        }
    fftw_execute(entries.backward);

    std::vector<FullMatrix<double>> kernel(N);
    for (unsigned int k = 0; k < N; ++k)
      kernel[k] =
        FullMatrix<double>(p, p, entries.values.data() + k * n_entries);
    return kernel;
  }
} // namespace Crevasse
