// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

// Projected SOR against brute force: on random symmetric positive definite
// problems every subset of active bounds is tried, and the one that satisfies
// the complementarity conditions is the solution. And the certificate tells
// wrong solutions from right ones.

#include <crevasse/base/problems.h>
#include <crevasse/contact/projected_sor.h>
#include <crevasse/contact/sweep.h>

#include <deal.II/lac/dynamic_sparsity_pattern.h>

#include <crevasse_tests/random_problem.h>
#include <crevasse_tests/tests.h>

using namespace Crevasse;

namespace
{
  constexpr unsigned int n = 9, n_bounds = 6;

  Certificate
  certify_alone(const SignoriniProblem &problem,
                const Vector           &b,
                const Vector           &candidate)
  {
    Scales        scales;
    Vector        residual(n);
    ContactForces forces;
    return certify(problem, {b, candidate}, scales, residual, forces);
  }

  void
  compare_with_enumeration(const double scale)
  {
    double       largest_error = 0., largest_certificate = 0.;
    unsigned int unsolved = 0;
    for (unsigned int seed = 0; seed < 100; ++seed)
      {
        const RandomProblem    random(seed, n, n_bounds, scale);
        const SignoriniProblem problem(random.matrix, random.bounds);
        Vector                 exact(n);
        std::vector<double>    forces;
        double                 best = 1e300;
        for (unsigned int active = 0; active < (1u << n_bounds); ++active)
          {
            const Vector candidate = random.solve_with(active);
            const double worst =
              certify_alone(problem, random.b, candidate).worst();
            if (worst < best)
              {
                best  = worst;
                exact = candidate;
              }
          }
        if (best > 1e-9)
          ++unsolved;

        ProjectedSor solver(problem, 1.3, 1e-13, 100000);
        Vector       q(n);
        solver.solve(random.b, q, forces);
        largest_certificate = std::max(largest_certificate,
                                       solver.statistics().certificate.worst());
        q -= exact;
        largest_error =
          std::max(largest_error, q.linfty_norm() / exact.linfty_norm());
      }
    section("matrices scaled by 1e" +
            std::to_string(std::lround(std::log10(scale))));
    check("enumeration found every solution", unsolved == 0);
    check_below("projected SOR, relative error", largest_error, 1e-9);
    check_below("certificate", largest_certificate, 2e-13);
  }

  void
  certificate_sees_errors()
  {
    const RandomProblem    random(7, n, n_bounds, 1.);
    const SignoriniProblem problem(random.matrix, random.bounds);
    ProjectedSor           solver(problem, 1.3, 1e-13, 100000);
    Vector                 q(n);
    std::vector<double>    forces;
    solver.solve(random.b, q, forces);

    const auto worst = [&](const Vector &candidate) {
      return certify_alone(problem, random.b, candidate).worst();
    };
    for (unsigned int i = 0; i < n; ++i)
      {
        Vector wrong(q);
        wrong(i) += 1e-6 * q.linfty_norm();
        if (!(worst(wrong) > 1e-8))
          check("a change of unknown " + std::to_string(i) + " is seen", false);
      }
    Vector not_a_number(q);
    not_a_number(3) = std::nan("");
    check("nan is seen", !(worst(not_a_number) <= 1.));

    bool refused = false;
    try
      {
        ProjectedSor hasty(problem, 1.3, 1e-13, 3);
        q = 0.;
        hasty.solve(random.b, q, forces);
      }
    catch (const NumericalError &)
      {
        refused = true;
      }
    check("three iterations are refused as a solution", refused);
  }

  /** After a load, none: the body returns to rest to the accuracy that the
   * load has set, which a scale of this one solve would never grant. */
  void
  zero_load_after_load()
  {
    const RandomProblem    random(3, n, n_bounds, 1.);
    const SignoriniProblem problem(random.matrix, random.bounds);
    ProjectedSor           solver(problem, 1.3, 1e-12, 10000);
    Vector                 q(n), zero(n);
    std::vector<double>    forces;
    solver.solve(random.b, q, forces);
    const double size = q.linfty_norm();
    solver.solve(zero, q, forces);
    check_below("rest after a load", q.linfty_norm() / size, 1e-10);
  }

  /** The model problem −u″ = 1 on 40 nodes: the best factor is known. */
  void
  find_known_factor()
  {
    constexpr unsigned int         m = 40;
    dealii::DynamicSparsityPattern pattern(m, m);
    for (unsigned int i = 0; i < m; ++i)
      for (int j = -1; j <= 1; ++j)
        if (int(i) + j >= 0 && i + j < m)
          pattern.add(i, i + j);
    SparseMatrix matrix;
    matrix.reinit(pattern);
    for (unsigned int i = 0; i < m; ++i)
      {
        matrix.set(i, i, 2.);
        if (i > 0)
          matrix.set(i, i - 1, -1.);
        if (i + 1 < m)
          matrix.set(i, i + 1, -1.);
      }
    matrix.compress(dealii::VectorOperation::insert);
    const UnilateralBounds none;
    const SignoriniProblem problem(matrix, none);
    Vector                 b(m);
    b = 1.;
    const Sweep  sweep(problem);
    const double theory = 2. / (1. + std::sin(dealii::numbers::PI / (m + 1)));
    const double found  = sweep.best_factor(b, 1e-8, 100000);
    const auto   count  = [&](const double factor) {
      return sweep.count_iterations(b, factor, 1e-8, 100000).iterations;
    };
    check("the factor found needs at most 5 % more iterations than theory's",
          count(found) <= 1.05 * count(theory));
    check("and far fewer than its neighbours 2 - 2 (2 - w), 2 - (2 - w) / 2",
          1.5 * count(found) < count(2. - 2. * (2. - found)) &&
            1.5 * count(found) < count(2. - 0.5 * (2. - found)));
  }
} // namespace

void
projected_sor()
{
  for (const double scale : {1., 1e12, 1e-12})
    compare_with_enumeration(scale);
  section("certificates");
  certificate_sees_errors();
  zero_load_after_load();
  find_known_factor();
}
