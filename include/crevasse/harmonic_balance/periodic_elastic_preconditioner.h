// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_harmonic_balance_periodic_elastic_preconditioner_h
#define crevasse_harmonic_balance_periodic_elastic_preconditioner_h

#include <crevasse/harmonic_balance/periodic_convolution.h>

#include <deal.II/lac/lapack_full_matrix.h>
#include <deal.II/lac/vector.h>

#include <vector>

namespace Crevasse
{
  /**
   * The bordered system of PeriodicSystem with the elastic compliance S_e in
   * place of the convolution, which is then a matrix by itself for each
   * instant:
   *
   *     (D + S_e) x + c = right on the active entries,    mean(x) = mean.
   *
   * Its solutions have the mean asked for, so that a Krylov method
   * preconditioned by it stays among functions of zero mean.
   */
  class PeriodicElasticPreconditioner
  {
  public:
    /** Keeps a reference to the convolution. */
    PeriodicElasticPreconditioner(const PeriodicConvolution &convolution);

    /**
     * Inverts the matrices of all instants: p³ operations each.
     *
     * @param active which of the p N entries are unknown
     * @param diagonal D ≥ 0, p N entries
     */
    void
    reinit(const std::vector<bool>      &active,
           const dealii::Vector<double> &diagonal);

    /**
     * @param right p N entries
     * @param means p entries
     * @param[out] x p N entries, zero where not active
     * @param[out] offsets c, p entries
     */
    void
    solve(const dealii::Vector<double> &right,
          const dealii::Vector<double> &means,
          dealii::Vector<double>       &x,
          dealii::Vector<double>       &offsets) const;

  private:
    const PeriodicConvolution &convolution;

    std::vector<std::vector<unsigned int>>        nodes; ///< of each instant
    std::vector<dealii::LAPACKFullMatrix<double>> inverses;
    dealii::LAPACKFullMatrix<double>              border; ///< for c, factored
  };
} // namespace Crevasse

#endif
