// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_harmonic_balance_periodic_convolution_h
#define crevasse_harmonic_balance_periodic_convolution_h

#include <crevasse/harmonic_balance/periodic_contact.h>

namespace Crevasse
{
  /**
   * The convolution S ∗ g of PeriodicContactProblem with functions of N
   * equidistant instants at p nodes, by fast Fourier transforms along time
   * (FFTW, real to complex): with ĝₙ = Σ_j g(t_j) exp(−2πi n j/N),
   *
   *     (S ∗ g)(t_j) = (2/N) Re Σₙ Sₙ ĝₙ exp(2πi n j/N),    n = 1 … N/2,
   *
   * where the last harmonic of an even N counts half; with a mean_compliance n
   * begins with 0, which counts half. A function is one vector
   * of p N entries: all nodes of the first instant, of the second, and so on.
   */
  class PeriodicConvolution
  {
  public:
    /** Plans the transforms. Shares the p × p matrices of the @p problem. */
    PeriodicConvolution(const PeriodicContactProblem &problem,
                        const unsigned int            n_nodes,
                        const unsigned int            n_instants);
    ~PeriodicConvolution();

    /** Computes S ∗ g, p N entries; without a mean_compliance their mean is
     * zero whatever the mean of g. */
    void
    vmult(dealii::Vector<double>       &result,
          const dealii::Vector<double> &function) const;

    /** Kernel C(t_k) of the convolution, k = 0 … N − 1, p × p matrices with (S
     * ∗ g)(t_j) = Σ_k C(t_j − t_k) g(t_k): N p² numbers. */
    std::vector<dealii::FullMatrix<double>>
    kernel() const;

    /** Largest |diagonal entry| of all compliances Sₙ; 0 without harmonics. */
    double largest_compliance = 0.;

    /** Re Sₙ for the highest n, which is close to the elastic compliance: a
     * symmetric positive definite p × p matrix, for preconditioners; empty if
     * there are no harmonics. */
    dealii::FullMatrix<double> elastic_compliance;

    const bool         has_mean;   ///< whether there is a mean_compliance
    const unsigned int n_nodes;    ///< number p of nodes
    const unsigned int n_instants; ///< number N of instants

  private:
    struct Transforms;

    /** Compliances with their n, ascending. */
    std::map<unsigned int, PeriodicContactProblem::Compliance> compliances;
    const std::unique_ptr<Transforms>                          transforms;

    /** Scratch data of vmult(): a harmonic, and its response. */
    mutable dealii::Vector<std::complex<double>> harmonic, response;
  };
} // namespace Crevasse

#endif
