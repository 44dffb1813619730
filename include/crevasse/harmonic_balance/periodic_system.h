// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_harmonic_balance_periodic_system_h
#define crevasse_harmonic_balance_periodic_system_h

#include <crevasse/harmonic_balance/periodic_convolution.h>

#include <deal.II/lac/lapack_full_matrix.h>

namespace Crevasse
{
  /**
   * The bordered linear systems of PeriodicContactProblem, on active entries A
   * of a function of p nodes and N instants:
   *
   *     S ∗ x + c = right on A,   x = 0 elsewhere,   mean(x) = mean.
   *
   * With a mean_compliance c = 0, and the mean of x is not given.
   *
   * Small systems are factored: the kernel of the convolution is a dense
   * matrix. Large systems are solved by GMRES, with the convolution by Fourier
   * transforms, and factored only if GMRES does not converge. The
   * preconditioner replaces the convolution by the elastic compliance, which
   * needs one small matrix for each instant; its solutions have the given mean.
   */
  class PeriodicSystem
  {
  public:
    /** Creates a system without active entries. Arguments must outlive it. */
    PeriodicSystem(const PeriodicConvolution    &convolution,
                   const PeriodicContactOptions &options);

    /** Sets the active entries, at least one a node if means are given, and
     * prepares solving.
     *
     * @param shift D ≥ 0 of proximal points, added to the diagonal.
     * @throw NumericalError if the matrix is singular. */
    void
    reinit(const std::vector<bool> &active, const double shift = 0.);

    /**
     * Solves a system.
     *
     * @param right p N entries, of which only active ones are used
     * @param means p entries
     * @param accuracy allowed residual of GMRES, root mean square
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

    /** Product with the matrix, for GMRES, of x and c, one after the other. The
     * equations of the mean hold from the start: their result is 0. */
    void
    vmult(LipVector &result, const LipVector &x_and_c) const;

    /** Total number of GMRES steps; 0 if all systems were factored. */
    unsigned int n_iterations = 0;

  private:
    /** Preconditioner of GMRES, with the elastic compliance. */
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
      dealii::LAPACKFullMatrix<double>              border;   ///< matrix for c

    private:
      /** Scratch data of vmult(): c, and the unknowns of one instant. */
      mutable LipVector offsets, before, after;
    };

    void
    factor();

    void
    prepare_preconditioner();

    /** Solves by GMRES. @return whether it converged. */
    bool
    solve_iteratively(const LipVector &right,
                      const double     accuracy,
                      LipVector       &x);

    const PeriodicConvolution    &convolution;
    const PeriodicContactOptions &options;
    const unsigned int            n_offsets; ///< p, or 0

    /** Active entries, ascending, and where each instant begins among them. */
    std::vector<unsigned int> unknowns, begins;

    std::vector<dealii::FullMatrix<double>> kernel;  ///< empty until factored
    dealii::LAPACKFullMatrix<double>        matrix;  ///< LU factors, or empty
    LipVector                               scaling; ///< scale of rows, columns
    Preconditioner                          preconditioner;
    double                                  shift = 0.;

    /** Scratch data of vmult(): x at all p N entries, 0 at inactive ones, and S
     * ∗ x. */
    mutable LipVector all_entries, convolved;
  };
} // namespace Crevasse

#endif
