// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/harmonic_balance/periodic_convolution.h>

#include <deal.II/base/exceptions.h>

#include <algorithm>
#include <cmath>
#include <fftw3.h>

namespace Crevasse
{
  using namespace dealii;

  namespace
  {
    using Complex = std::complex<double>;
  }

  /** Buffers and plans of both transforms between N reals and N/2 + 1 complex
   * numbers, for many interleaved functions. */
  struct PeriodicConvolution::Transforms
  {
    Transforms(const int N, const int n_functions)
      : values(static_cast<std::size_t>(N) * n_functions)
      , harmonics(static_cast<std::size_t>(N / 2 + 1) * n_functions)
    {
      const int  n   = n_functions;
      double    *x   = values.data();
      const auto x_n = reinterpret_cast<fftw_complex *>(harmonics.data());
      // Estimated plans do not depend on the load of the machine.
      forward = fftw_plan_many_dft_r2c(
        1, &N, n, x, nullptr, n, 1, x_n, nullptr, n, 1, FFTW_ESTIMATE);
      backward = fftw_plan_many_dft_c2r(
        1, &N, n, x_n, nullptr, n, 1, x, nullptr, n, 1, FFTW_ESTIMATE);
      AssertThrow(forward != nullptr && backward != nullptr,
                  ExcMessage("FFTW made no plan."));
    }

    ~Transforms()
    {
      fftw_destroy_plan(forward);
      fftw_destroy_plan(backward);
    }

    std::vector<double>  values;
    std::vector<Complex> harmonics;
    fftw_plan            forward, backward;
  };



  PeriodicConvolution::PeriodicConvolution(
    const PeriodicContactProblem &problem,
    const unsigned int            n_nodes,
    const unsigned int            n_instants)
    : has_mean(problem.mean_compliance)
    , n_nodes(n_nodes)
    , n_instants(n_instants)
    , transforms(std::make_unique<Transforms>(n_instants, n_nodes))
    , harmonic(n_nodes)
    , response(n_nodes)
  {
    AssertDimension(problem.compliances.size(), n_instants / 2);
    if (has_mean)
      compliances[0] = *problem.mean_compliance;
    for (unsigned int n = 1; n <= n_instants / 2; ++n)
      compliances[n] = problem.compliances[n - 1];
    for (const auto &[n, compliance] : compliances)
      {
        const auto &[matrix, factor] = compliance;
        elastic_compliance.reinit(n_nodes, n_nodes); // the last one remains
        for (unsigned int i = 0; i < n_nodes; ++i)
          {
            largest_compliance =
              std::max(largest_compliance, std::abs(factor * (*matrix)(i, i)));
            for (unsigned int j = 0; j < n_nodes; ++j)
              elastic_compliance(i, j) =
                0.5 * std::real(factor * ((*matrix)(i, j) + (*matrix)(j, i)));
          }
      }
  }



  PeriodicConvolution::~PeriodicConvolution() = default;



  void
  PeriodicConvolution::vmult(dealii::Vector<double>       &result,
                             const dealii::Vector<double> &function) const
  {
    const unsigned int p = n_nodes;
    std::copy(function.begin(), function.end(), transforms->values.begin());
    fftw_execute(transforms->forward);
    if (!has_mean)
      std::fill_n(transforms->harmonics.begin(), p, Complex(0.));
    for (const auto &[n, compliance] : compliances)
      {
        const auto &[matrix, factor] = compliance;
        const auto of_nodes          = transforms->harmonics.begin() + n * p;
        std::copy_n(of_nodes, p, harmonic.begin());
        matrix->vmult(response, harmonic);
        // FFTW's transforms do not divide by N. The inverse transform uses only
        // the real part of the last harmonic of an even N.
        for (unsigned int i = 0; i < p; ++i)
          of_nodes[i] =
            response(i) * (factor / static_cast<double>(n_instants));
      }
    fftw_execute(transforms->backward);
    result.reinit(function.size(), true);
    std::copy(transforms->values.begin(),
              transforms->values.end(),
              result.begin());
  }



  std::vector<FullMatrix<double>>
  PeriodicConvolution::kernel() const
  {
    const std::size_t n_entries = std::size_t(n_nodes) * n_nodes;
    Transforms        entries(n_instants, n_entries);
    for (const auto &[n, compliance] : compliances)
      {
        const auto &[matrix, factor] = compliance;
        auto entry = entries.harmonics.begin() + n * n_entries;
        for (unsigned int i = 0; i < n_nodes; ++i)
          for (unsigned int j = 0; j < n_nodes; ++j)
            *entry++ =
              factor / static_cast<double>(n_instants) * (*matrix)(i, j);
      }
    fftw_execute(entries.backward);
    std::vector<FullMatrix<double>> kernel;
    for (unsigned int k = 0; k < n_instants; ++k)
      kernel.emplace_back(n_nodes,
                          n_nodes,
                          entries.values.data() + k * n_entries);
    return kernel;
  }
} // namespace Crevasse
