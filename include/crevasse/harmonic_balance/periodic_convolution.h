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
   * where the last harmonic of an even N counts half. A function is one vector
   * of p N entries: all nodes of the first instant, of the second, and so on.
   */
  class PeriodicConvolution
  {
  public:
    /** Shares the matrices of the compliances S₁ … S_{N/2}, each p × p. */
    PeriodicConvolution(
      const std::vector<PeriodicContactProblem::Compliance> &compliances,
      const unsigned int                                     n_nodes,
      const unsigned int                                     n_instants);
    ~PeriodicConvolution();

    /** S ∗ g, p N entries; whatever the mean of g, the result has none. */
    void
    vmult(dealii::Vector<double>       &result,
          const dealii::Vector<double> &function) const;

    /** The kernel C(t_k), k = 0 … N − 1, p × p matrices with
     * (S ∗ g)(t_j) = Σ_k C(t_j − t_k) g(t_k). N p² numbers. */
    std::vector<dealii::FullMatrix<double>>
    kernel() const;

    /** The largest |entry| on the diagonals of all Sₙ; 0 without harmonics. */
    double largest_compliance = 0.;

    /** Re Sₙ for the highest n, which is next to the elastic compliance: a
     * symmetric positive definite p × p matrix, for preconditioners; of no
     * entries if there is no harmonic. */
    dealii::FullMatrix<double> elastic_compliance;

    const unsigned int n_nodes;    ///< p
    const unsigned int n_instants; ///< N

  private:
    struct Transforms;

    const std::vector<PeriodicContactProblem::Compliance> compliances;
    const std::unique_ptr<Transforms>                     transforms;

    /** Of vmult(): one harmonic, and what its compliance makes of it. */
    mutable dealii::Vector<std::complex<double>> harmonic, response;
  };
} // namespace Crevasse

#endif
