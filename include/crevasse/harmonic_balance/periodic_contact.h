// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_harmonic_balance_periodic_contact_h
#define crevasse_harmonic_balance_periodic_contact_h

#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/vector.h>

#include <complex>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace Crevasse
{
  /** Values at nodes of the lip, one for each node or each node and instant. */
  using LipVector = dealii::Vector<double>;

  /**
   * One-sided contact of a periodic motion, at N equidistant instants t_j of
   * the period and at all nodes i of the lip that bear a mean force ḡ > 0:
   *
   *     w_i(t_j) = w⁰_i(t_j) + (S ∗ g)_i(t_j) + c_i,
   *     0 ≤ g_i(t_j) ⟂ w_i(t_j) ≥ 0,       (1/N) Σ_j g_i(t_j) = ḡ_i
   *
   * with unknown forces g and one unknown offset c for each node. The
   * convolution S ∗ g multiplies the harmonics n = 1 … N/2 of g by the
   * compliances Sₙ, complex symmetric matrices whose real parts are positive
   * definite (at least the elastic compliance), and removes the mean: hence the
   * solution g is unique, and so is c where a node opens.
   */
  struct PeriodicContactProblem
  {
    /** Compliance Sₙ = factor × matrix; multiples share their matrix. */
    struct Compliance
    {
      std::shared_ptr<const dealii::FullMatrix<std::complex<double>>> matrix;
      std::complex<double> factor = 1.;
    };

    /** Compliances S₁ … S_⌊N/2⌋; for an even N the last one is real. */
    std::vector<Compliance> compliances;

    /** Compliance S₀, real. If it is given, S ∗ g includes the mean, w⁰ is all
     * of the opening without contact, c = 0, and the mean of g follows. */
    std::optional<Compliance> mean_compliance;

    /** Openings w⁰ without contact for each of the N instants. */
    std::vector<dealii::Vector<double>> openings_without_contact;

    /** Mean forces ḡ > 0 for each node; 0 with a mean_compliance. */
    dealii::Vector<double> mean_forces;
  };

  /** Errors of forces and offsets as a solution of a PeriodicContactProblem,
   * relative to the largest force, and to the largest opening without contact
   * plus what the largest force causes by itself. 0 is exact. */
  struct PeriodicContactCertificate
  {
    double penetration     = 0.; ///< largest −w
    double tension         = 0.; ///< largest −g
    double complementarity = 0.; ///< largest |g w|
    double mean_defect     = 0.; ///< largest |mean(g) − ḡ|

    /** Largest of the four errors; infinite if one is not a number. */
    double
    worst() const;

    /** The four errors with their names. */
    std::string
    describe() const;
  };

  /** Solution of a PeriodicContactProblem in its units, and the effort. */
  struct PeriodicContactSolution
  {
    std::vector<dealii::Vector<double>> forces;  ///< forces g for each instant
    dealii::Vector<double>              offsets; ///< offset c of each node

    PeriodicContactCertificate certificate        = {};
    unsigned int               n_sets             = 0;
    unsigned int               n_proximal_steps   = 0; ///< usually 0 steps
    unsigned int               n_gmres_iterations = 0;

    /** Summary for the log, e.g. "active set, factored, certificate: …". */
    std::string
    describe() const;
  };

  struct PeriodicContactOptions
  {
    /** Largest error allowed in the certificate. */
    double tolerance = 1e-9;
    /** Largest number of unknowns of a system that is factored rather than
     * solved by GMRES: about where both take the same time. */
    unsigned int largest_dense_system = 350;
    /** Largest number of GMRES steps for a system before it is factored. */
    unsigned int most_gmres_steps = 2000;
  };

  /**
   * Solves a PeriodicContactProblem by a primal–dual active set: with w = 0 at
   * the nodes and instants of the set, g = 0 at the others and the mean of g
   * given, g and c follow from one linear system; entries with tension leave
   * the set, penetrating ones enter it (Hintermüller, Ito and Kunisch, SIAM J.
   * Optim. 13, 2002). Usually a few sets suffice. If sets recur, proximal
   * points (Rockafellar, SIAM J. Control Optim. 14, 1976) approach the solution
   * until they do; these converge, as the problem is monotone.
   *
   * @throw NumericalError if a number is not finite, or no set solves the
   * problem to the tolerance.
   */
  PeriodicContactSolution
  solve_periodic_contact(const PeriodicContactProblem &problem,
                         const PeriodicContactOptions &options = {});

  /** Computes the errors of a solution, at the cost of one convolution. */
  PeriodicContactCertificate
  certify(const PeriodicContactProblem  &problem,
          const PeriodicContactSolution &solution);
} // namespace Crevasse

#endif
