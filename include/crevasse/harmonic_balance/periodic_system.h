// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_harmonic_balance_periodic_system_h
#define crevasse_harmonic_balance_periodic_system_h

#include <crevasse/harmonic_balance/periodic_convolution.h>
#include <crevasse/harmonic_balance/periodic_elastic_preconditioner.h>

#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/lapack_full_matrix.h>
#include <deal.II/lac/vector.h>

#include <vector>

namespace Crevasse
{
  /**
   * The bordered linear systems of PeriodicContactProblem, on active entries
   * A of the p N of a function, with a diagonal D ≥ 0:
   *
   *     D x + S ∗ x + c = right on A,   x = 0 elsewhere,   mean(x) = mean.
   *
   * Small ones are factored: the kernel of the convolution is a dense matrix.
   * Large ones are left to GMRES, with the convolution by Fourier transforms
   * and preconditioned by PeriodicElasticPreconditioner, and factored only if
   * that does not converge.
   */
  class PeriodicSystem
  {
  public:
    /**
     * Keeps a reference to the convolution.
     *
     * @param largest_dense_system how many active entries and nodes together
     * are still factored
     * @param most_steps of GMRES for one system
     */
    PeriodicSystem(const PeriodicConvolution &convolution,
                   const unsigned int         largest_dense_system,
                   const unsigned int         most_steps = 2000);

    /**
     * Makes these the active entries and prepares solutions.
     *
     * @param active p N entries; for each node at least one is true
     * @param diagonal D, p N entries
     * @throw NumericalError if the matrix is singular.
     */
    void
    reinit(const std::vector<bool>      &active,
           const dealii::Vector<double> &diagonal);

    /**
     * Solves a system.
     *
     * @param right p N entries; those that are not active do not matter
     * @param means p entries
     * @param accuracy what GMRES may leave of the equations, root mean square
     * @param[out] x p N entries
     * @param[out] offsets c, p entries
     * @throw NumericalError if GMRES does not converge and there are too many
     * unknowns for a factorisation.
     */
    void
    solve(const dealii::Vector<double> &right,
          const dealii::Vector<double> &means,
          const double                  accuracy,
          dealii::Vector<double>       &x,
          dealii::Vector<double>       &offsets);

    /** How many right-hand sides were solved for. */
    unsigned int
    n_solves() const
    {
      return solves;
    }

    /** Steps of GMRES in all; 0 if everything was factored. */
    unsigned int
    n_iterations() const
    {
      return iterations;
    }

    /** Of active entries and nodes, in the largest system so far. */
    unsigned int
    largest_system() const
    {
      return largest;
    }

  private:
    void
    factor();

    /** Where GMRES has failed, unless there are too many unknowns. */
    void
    factor_after_all();

    void
    solve_dense(const dealii::Vector<double> &right,
                const dealii::Vector<double> &means,
                dealii::Vector<double>       &x,
                dealii::Vector<double>       &offsets) const;

    /** @return whether GMRES converged. */
    bool
    solve_iteratively(const dealii::Vector<double> &right,
                      const dealii::Vector<double> &means,
                      const double                  accuracy,
                      dealii::Vector<double>       &x,
                      dealii::Vector<double>       &offsets);

    const PeriodicConvolution &convolution;
    const unsigned int         largest_dense_system;
    const unsigned int         most_steps;

    std::vector<unsigned int> unknowns; ///< the active entries, ascending
    dealii::Vector<double>    diagonal;

    std::vector<dealii::FullMatrix<double>> kernel; ///< if ever factored
    dealii::LAPACKFullMatrix<double>        matrix;
    dealii::Vector<double>                  scaling; ///< of rows and columns

    PeriodicElasticPreconditioner preconditioner;

    unsigned int solves     = 0;
    unsigned int iterations = 0;
    unsigned int largest    = 0;
  };
} // namespace Crevasse

#endif
