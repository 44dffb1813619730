// ---------------------------------------------------------------------
//
// Copyright (C) 2026 by the Crevasse authors
//
// This file is part of Crevasse. It is free software; you can use it,
// redistribute it and/or modify it under the terms of the GNU Lesser
// General Public License as published by the Free Software Foundation;
// either version 2.1 of the License, or (at your option) any later version.
//
// ---------------------------------------------------------------------

#ifndef crevasse_contact_contact_solver_h
#define crevasse_contact_contact_solver_h

#include <crevasse/contact/certificate.h>
#include <crevasse/contact/signorini_problem.h>

#include <deal.II/base/timer.h>

#include <cstddef>
#include <string>
#include <vector>

namespace Crevasse
{
  /**
   * Solves one Signorini problem for many right-hand sides and certifies every
   * solution. What is not within tolerance is thrown, never returned.
   */
  class ContactSolver
  {
  public:
    ContactSolver(const SignoriniProblem &problem, const double tolerance);
    virtual ~ContactSolver() = default;

    /**
     * @param[in,out] solution The start of iterative methods; then q.
     * @param[out] contact_forces g for each locally owned bound.
     * @throw NumericalError with certificate and advice if no solution within
     * tolerance was found.
     */
    void
    solve(const Vector        &right_hand_side,
          Vector              &solution,
          std::vector<double> &contact_forces);

    /** The maxima over all solves so far. */
    const Certificate &
    worst_certificate() const;

    std::size_t
    n_solves() const;

    std::size_t
    n_iterations() const;

    /** Wall time spent in solve(), certificates included. */
    double
    seconds() const;

    /** For the log and the summary: which method, with which settings. */
    virtual std::string
    description() const = 0;

  protected:
    /** Improves @p solution until its certificate is within the tolerance or
     * nothing more can be done; returns the number of iterations. */
    virtual std::size_t
    iterate(const Vector &right_hand_side, Vector &solution) = 0;

    /** Certifies into this object's own work space. */
    Certificate
    certify(const Vector &right_hand_side, const Vector &solution);

    const SignoriniProblem &problem;
    const double            tolerance;
    Scales                  scales; ///< of all solves so far

  private:
    Vector              residual;
    std::vector<double> forces;
    Certificate         maxima;
    std::size_t         solves     = 0;
    std::size_t         iterations = 0;
    dealii::Timer       timer;
  };
} // namespace Crevasse

#endif
