// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_harmonic_balance_periodic_system_h
#define crevasse_harmonic_balance_periodic_system_h

#include <crevasse/harmonic_balance/periodic_convolution.h>

#include <deal.II/lac/lapack_full_matrix.h>

namespace Crevasse
{
  /**
   * The bordered linear systems of PeriodicContactProblem, on active entries
   * A of the p N of a function:
   *
   *     S ∗ x + c = right on A,   x = 0 elsewhere,   mean(x) = mean.
   *
   * Small ones are factored: the kernel of the convolution is a dense matrix.
   * Large ones are left to GMRES, with the convolution by Fourier transforms,
   * and factored only if that does not converge. Its preconditioner has the
   * elastic compliance in place of the convolution, and so a matrix by itself
   * for each instant; its solutions have the mean asked for.
   */
  class PeriodicSystem
  {
  public:
    /** Keeps references. */
    PeriodicSystem(const PeriodicConvolution    &convolution,
                   const PeriodicContactOptions &options);

    /** Makes these the active entries, of p N, with at least one for each node,
     * and prepares solutions.
     *
     * @param shift D ≥ 0, a number.
     * @throw NumericalError if the matrix is singular. */
    void
    reinit(const std::vector<bool> &active, const double shift = 0.);

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
    solve(const LipVector &right,
          const LipVector &means,
          const double     accuracy,
          LipVector       &x,
          LipVector       &offsets);

    /** For GMRES: what x and c, one after the other, make of the equations on
     * A. Those of the mean hold from the start: 0. */
    void
    vmult(LipVector &result, const LipVector &x_and_c) const;

    /** Steps of GMRES in all; 0 if everything was factored. */
    unsigned int n_iterations = 0;

  private:
    /** With the elastic compliance. */
    struct Preconditioner
    {
      explicit Preconditioner(const PeriodicSystem &system)
        : system(system)
      {
      }

      void
      vmult(LipVector &x_and_c, const LipVector &right) const;

      const PeriodicSystem                         &system;
      std::vector<dealii::LAPACKFullMatrix<double>> inverses; ///< by instant
      dealii::LAPACKFullMatrix<double>              border;   ///< for c

    private:
      /** Of vmult(): c, and the unknowns of one instant. */
      mutable LipVector offsets, before, after;
    };

    void
    factor();

    void
    prepare_preconditioner();

    /** @return whether GMRES converged. */
    bool
    solve_iteratively(const LipVector &right,
                      const double     accuracy,
                      LipVector       &x);

    const PeriodicConvolution    &convolution;
    const PeriodicContactOptions &options;

    /** The active entries, ascending, and where those of each instant begin
     * among them. */
    std::vector<unsigned int> unknowns, begins;

    std::vector<dealii::FullMatrix<double>> kernel;  ///< if ever factored
    dealii::LAPACKFullMatrix<double>        matrix;  ///< factored, or empty
    LipVector                               scaling; ///< of rows and columns
    Preconditioner                          preconditioner;
    double                                  shift = 0.;

    /** Of vmult(): x at all p N entries, 0 at those that are not active, and
     * S ∗ x. */
    mutable LipVector all_entries, convolved;
  };
} // namespace Crevasse

#endif
