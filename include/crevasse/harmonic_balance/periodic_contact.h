// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_harmonic_balance_periodic_contact_h
#define crevasse_harmonic_balance_periodic_contact_h

#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/vector.h>

#include <complex>
#include <memory>
#include <string>
#include <vector>

namespace Crevasse
{
  /** A value for each of some nodes of the lip, or for each node and instant.
   */
  using LipVector = dealii::Vector<double>;

  /**
   * One-sided contact of a periodic motion, at N equidistant instants t_j of
   * the period and at all nodes i of the lip that bear a mean force ḡ > 0:
   *
   *     w_i(t_j) = w⁰_i(t_j) + (S ∗ g)_i(t_j) + c_i,
   *     0 ≤ g_i(t_j) ⟂ w_i(t_j) ≥ 0,       (1/N) Σ_j g_i(t_j) = ḡ_i
   *
   * with the forces g and one offset c a node unknown. The convolution S ∗ g
   * multiplies the harmonics n = 1 … N/2 of g by the compliances Sₙ, complex
   * symmetric matrices whose real parts are positive definite (at least the
   * elastic compliance), and takes away the mean: hence the solution g is
   * unique, and c too, where a node opens.
   */
  struct PeriodicContactProblem
  {
    /** Sₙ = factor × matrix: matrices that differ by a factor are shared. */
    struct Compliance
    {
      std::shared_ptr<const dealii::FullMatrix<std::complex<double>>> matrix;
      std::complex<double> factor = 1.;
    };

    /** S₁ … S_{N/2} (rounded down); the last one of an even N is real. */
    std::vector<Compliance> compliances;

    /** w⁰ for each instant, N of them. */
    std::vector<dealii::Vector<double>> openings_without_contact;

    /** ḡ > 0 for each node. */
    dealii::Vector<double> mean_forces;
  };

  /** How well forces and offsets solve a PeriodicContactProblem. All are
   * relative: forces to the largest one, openings to the largest one without
   * contact plus what the largest force does by itself. 0 is exact. */
  struct PeriodicContactCertificate
  {
    double penetration     = 0.; ///< largest −w
    double tension         = 0.; ///< largest −g
    double complementarity = 0.; ///< largest |g w|
    double mean_defect     = 0.; ///< largest |mean(g) − ḡ|

    /** The largest of the four; infinite if one is not a number. */
    double
    worst() const;

    /** All four with their names. */
    std::string
    describe() const;
  };

  /** The solution, in units of the problem, and what it took. */
  struct PeriodicContactSolution
  {
    std::vector<dealii::Vector<double>> forces;  ///< g for each instant
    dealii::Vector<double>              offsets; ///< c for each node

    PeriodicContactCertificate certificate        = {};
    unsigned int               n_sets             = 0;
    unsigned int               n_proximal_steps   = 0; ///< mostly none
    unsigned int               n_gmres_iterations = 0;

    /** For a log: "active set, factored, certificate: …" and the like. */
    std::string
    describe() const;
  };

  struct PeriodicContactOptions
  {
    /** Of the certificate. */
    double tolerance = 1e-9;
    /** Closed nodes and instants, and nodes, of a system that is factored
     * rather than solved by GMRES: about where both take the same time. */
    unsigned int largest_dense_system = 350;
    /** For one system; then it is factored. */
    unsigned int most_gmres_steps = 2000;
  };

  /**
   * Solves by a primal–dual active set: with w = 0 at the nodes and instants
   * of the set, g = 0 at the others and the mean of g given, g and c follow
   * from one linear system; what then has tension leaves the set, what
   * penetrates enters it (Hintermüller, Ito and Kunisch, SIAM J. Optim. 13,
   * 2002). It mostly ends after a few sets. Where sets come back, proximal
   * points (Rockafellar, SIAM J. Control Optim. 14, 1976) come so near to the
   * solution that it does; they converge, for the problem is monotone.
   *
   * @throw NumericalError if a number is not finite, or no set solves the
   * problem to the tolerance.
   */
  PeriodicContactSolution
  solve_periodic_contact(const PeriodicContactProblem &problem,
                         const PeriodicContactOptions &options = {});

  /** Certifies forces and offsets at the cost of one convolution. */
  PeriodicContactCertificate
  certify(const PeriodicContactProblem  &problem,
          const PeriodicContactSolution &solution);
} // namespace Crevasse

#endif
