// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_harmonic_balance_periodic_contact_h
#define crevasse_harmonic_balance_periodic_contact_h

#include <crevasse/harmonic_balance/periodic_active_set.h>
#include <crevasse/harmonic_balance/periodic_contact_certificate.h>
#include <crevasse/harmonic_balance/periodic_contact_problem.h>

#include <string>

namespace Crevasse
{
  /**
   * Solves PeriodicContactProblem: by a primal–dual active set, which mostly
   * needs a few sets; if it does not end, by an interior point method as far as
   * the set can be told, from which the first method finishes. The solution is
   * certified.
   */
  class PeriodicContact
  {
  public:
    struct Options
    {
      /** Of the certificate. */
      double tolerance = 1e-9;
      /** Sets tried before the interior point method is called for. */
      unsigned int most_active_sets = 15;
      /** Closed nodes and instants, and nodes, of a system that is factored
       * rather than solved by GMRES: about where both take the same time. */
      unsigned int largest_dense_system = 350;
    };

    /** What a solution took. */
    struct Statistics
    {
      unsigned int n_active_sets          = 0;
      unsigned int n_interior_point_steps = 0; ///< 0: it was not needed
      unsigned int n_linear_solves        = 0;
      unsigned int n_gmres_iterations     = 0;
      unsigned int largest_system         = 0; ///< unknowns

      /** For a log: "active set, factored" and the like. */
      std::string
      describe() const;
    };

    PeriodicContact(const Options &options);
    PeriodicContact();

    /**
     * @throw NumericalError if no set solves the problem to the tolerance.
     * @throw ExceptionBase if sizes do not match, a number is not finite or a
     * mean force is not positive.
     */
    PeriodicContactSolution
    solve(const PeriodicContactProblem &problem);

    /** The same, with the closed nodes and instants of the solution of a
     * similar problem, of as many nodes and instants, for a first set. */
    PeriodicContactSolution
    solve(const PeriodicContactProblem  &problem,
          const PeriodicContactSolution &start);

    /** Of the last solution. */
    const Statistics &
    statistics() const
    {
      return last_statistics;
    }

    const PeriodicContactCertificate &
    certificate() const
    {
      return last_certificate;
    }

  private:
    PeriodicContactSolution
    solve_from(const PeriodicContactProblem  &problem,
               const PeriodicContactSolution *start);

    void
    solve_with(const PeriodicComplementarity &problem,
               const PeriodicContactSolution *start,
               PeriodicState                 &state);

    /** @return whether the set that its points hint at was the solution's. */
    bool
    solve_by_interior_point(const PeriodicComplementarity &problem,
                            PeriodicSystem                &system,
                            PeriodicActiveSet             &active_set,
                            PeriodicState                 &state);

    const Options              options;
    Statistics                 last_statistics;
    PeriodicContactCertificate last_certificate;
  };
} // namespace Crevasse

#endif
