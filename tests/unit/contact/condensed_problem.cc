// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

// The problem on the lip against brute force: 1000 random symmetric positive
// definite stiffnesses (seeded) with up to 10 nodes, some nearly singular, some
// with degenerate nodes (w = g = 0). Active sets cycle on some of them;
// changing one node at a time must end them. And the factor of a set that
// changes against one that is made anew.

#include <crevasse/contact/condensed_problem.h>

#include <deal.II/lac/full_matrix.h>

#include <crevasse_tests/tests.h>
#include <random>

using namespace Crevasse;

namespace
{
  using Dense = dealii::LAPACKFullMatrix<double>;
  using Small = dealii::Vector<double>;

  /** max over nodes of |min(g / |c|, w / |w|)|, and of what is negative. */
  double
  violation(const Dense &A, const Small &loads, const Small &w)
  {
    Small g(loads.size());
    A.vmult(g, w);
    g -= loads;
    const double force  = loads.linfty_norm();
    const double length = std::max(1e-300, w.linfty_norm());
    double       worst  = 0.;
    for (unsigned int i = 0; i < g.size(); ++i)
      worst = std::max(worst, std::abs(std::min(g(i) / force, w(i) / length)));
    return worst;
  }

  /** w = A⁻¹ c on the open nodes, by a factor that is made for them. */
  Small
  opening_of(const Dense             &A,
             const Small             &loads,
             const std::vector<bool> &is_open)
  {
    const unsigned int         n = loads.size();
    dealii::FullMatrix<double> system{dealii::IdentityMatrix(n)};
    Small                      right(n), w(n);
    for (unsigned int i = 0; i < n; ++i)
      if (is_open[i])
        {
          right(i) = loads(i);
          for (unsigned int j = 0; j < n; ++j)
            system(i, j) = is_open[j] ? A(i, j) : 0.;
        }
    system.gauss_jordan();
    system.vmult(w, right);
    return w;
  }

  /** The solution among all sets: the one that violates least. */
  double
  best_of_all_sets(const Dense &A, const Small &loads)
  {
    const unsigned int n    = loads.size();
    double             best = 1e300;
    for (unsigned int set = 0; set < (1u << n); ++set)
      {
        std::vector<bool> is_open(n);
        for (unsigned int i = 0; i < n; ++i)
          is_open[i] = (set >> i) & 1;
        best =
          std::min(best, violation(A, loads, opening_of(A, loads, is_open)));
      }
    return best;
  }

  Dense
  random_matrix(const unsigned int n, const double shift, std::mt19937 &random)
  {
    std::uniform_real_distribution<double> uniform(-1., 1.);
    dealii::FullMatrix<double>             root(n, n), product(n, n);
    for (unsigned int i = 0; i < n; ++i)
      for (unsigned int j = 0; j < n; ++j)
        root(i, j) = uniform(random);
    root.Tmmult(product, root);
    for (unsigned int i = 0; i < n; ++i)
      product(i, i) += shift;
    Dense A(n, n);
    A = product;
    return A;
  }

  Small
  upward(const unsigned int n)
  {
    Small sign(n);
    sign = 1.;
    return sign;
  }

  /** Turned coordinates turn the solution, to the last bit. */
  bool
  keeps_solution_where_turned(const Dense &A, Small loads, const double length)
  {
    const unsigned int n    = loads.size();
    Small              sign = upward(n), gap(n), w(n), turned_w(n);
    Dense              turned(A);
    for (unsigned int i = 0; i < n; ++i)
      {
        sign(i) = i % 3 == 1 ? 1. : -1.;
        gap(i)  = (i % 2 == 0 ? 0.3 : -0.3) * length;
      }
    for (unsigned int i = 0; i < n; ++i)
      for (unsigned int j = 0; j < n; ++j)
        turned(i, j) *= sign(i) * sign(j);
    CondensedProblem(A, upward(n), gap).solve(loads, w);
    loads.scale(sign);
    CondensedProblem(turned, sign, gap).solve(loads, turned_w);
    turned_w.scale(sign);
    return turned_w == w;
  }

  void
  random_problems(const double scale)
  {
    std::mt19937                           generator(1974);
    std::uniform_real_distribution<double> uniform(-1., 1.);
    double                                 worst = 0., worst_possible = 0.;
    unsigned int                           rescues = 0;
    for (unsigned int problem = 0; problem < 1000; ++problem)
      {
        const unsigned int n = 1 + problem % 10;
        Dense A = random_matrix(n, problem % 3 == 0 ? 1e-3 : 0.1, generator);
        A *= scale;
        Small loads(n), w(n);
        for (unsigned int i = 0; i < n; ++i)
          loads(i) = uniform(generator);
        if (problem % 7 == 0)
          {
            // A degenerate node: with the openings that solve for the others,
            // its force is zero and so is its opening.
            CondensedProblem(A, upward(n), Small(n)).solve(loads, w);
            if (Small forces(n); w(0) == 0.)
              {
                A.vmult(forces, w);
                loads(0) = forces(0);
              }
          }

        const Small      no_gap(n);
        CondensedProblem lip(A, upward(n), no_gap);
        lip.solve(loads, w);
        worst = std::max(worst, violation(A, loads, w));
        rescues += lip.n_rescues();
        if (!keeps_solution_where_turned(A, loads, w.linfty_norm()))
          check("the sign of a node is that of its coordinate", false);
        if (n <= 8)
          worst_possible = std::max(worst_possible, best_of_all_sets(A, loads));

        // Warm start with the solution's own set: nothing is left to do.
        if (lip.n_rescues() > 0 || problem % 7 == 0)
          continue;
        Small again(n);
        if (lip.solve(loads, again) != 1)
          check("a warm start needs one set", false);
        again -= w;
        if (again.linfty_norm() > 1e-10 * w.linfty_norm())
          check("a warm start gives the same openings", false);
      }
    section("stiffnesses scaled by 1e" +
            std::to_string(std::lround(std::log10(scale))));
    check_below("violation of the best of all sets", worst_possible, 1e-10);
    check_below("violation of the solution", worst, 1e-10);
    check("some cycles were met and ended", rescues > 0);
  }

  /** Fronts that run back and forth from either end, and random sets. */
  void
  changing_factor()
  {
    constexpr unsigned int n = 40;
    std::mt19937           generator(1980);
    const Dense            A = random_matrix(n, 0.1, generator);
    PrincipalFactor        factor(A);
    double                 worst = 0.;
    for (unsigned int k = 0; k < 400; ++k)
      {
        std::vector<bool>  set(n);
        const unsigned int front = k % (2 * n);
        for (unsigned int i = 0; i < n; ++i)
          set[i] = k < 160   ? i < (front <= n ? front : 2 * n - front)
                   : k < 320 ? i + 7 > front && i < n - front / 5
                             : generator() % 4 != 0;
        Small loads(n), w(n);
        for (unsigned int i = 0; i < n; ++i)
          w(i) = loads(i) = std::sin(1. + i);
        factor.choose(set);
        factor.solve(w);
        const Small expected = opening_of(A, loads, set);
        w -= expected;
        worst = std::max(worst, w.linfty_norm());
      }
    section("factor of a set that changes");
    check_below("difference to a factor made anew", worst, 1e-10);
  }
} // namespace

void
condensed_problem()
{
  for (const double scale : {1., 1e12, 1e-12})
    random_problems(scale);
  changing_factor();
}
