// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

// The problem on the lip against brute force: 1000 random symmetric positive
// definite compliances (seeded) with up to 10 nodes, some nearly singular, some
// with degenerate nodes (w = g = 0). Active sets cycle on some of them;
// changing one node at a time must end them.

#include <crevasse/contact/condensed_problem.h>

#include <deal.II/lac/full_matrix.h>

#include <crevasse_tests/tests.h>
#include <random>

using namespace Crevasse;

namespace
{
  using Dense = dealii::FullMatrix<double>;
  using Small = dealii::Vector<double>;

  /** max over nodes of |min(g / |g|, w / |w|)|, and of what is negative. */
  double
  violation(const Dense &S, const Small &w_0, const Small &g)
  {
    Small w(w_0);
    S.vmult_add(w, g);
    const double force  = std::max(1e-300, g.linfty_norm());
    const double length = w_0.linfty_norm();
    double       worst  = 0.;
    for (unsigned int i = 0; i < g.size(); ++i)
      worst = std::max(worst, std::abs(std::min(g(i) / force, w(i) / length)));
    return worst;
  }

  /** The solution among all sets: the one that violates least. */
  double
  best_of_all_sets(const Dense &S, const Small &w_0)
  {
    const unsigned int n    = w_0.size();
    double             best = 1e300;
    for (unsigned int set = 0; set < (1u << n); ++set)
      {
        Dense system{dealii::IdentityMatrix(n)};
        Small right(n), g(n);
        for (unsigned int i = 0; i < n; ++i)
          if ((set >> i) & 1)
            {
              right(i) = -w_0(i);
              for (unsigned int j = 0; j < n; ++j)
                system(i, j) = (set >> j) & 1 ? S(i, j) : 0.;
            }
        system.gauss_jordan();
        system.vmult(g, right);
        best = std::min(best, violation(S, w_0, g));
      }
    return best;
  }

  void
  random_problems(const double scale)
  {
    std::mt19937                           generator(1974);
    std::uniform_real_distribution<double> uniform(-1., 1.);
    double                                 worst = 0., worst_possible = 0.;
    unsigned int rescues = 0, columns_computed = 0, columns_in_all = 0;
    for (unsigned int problem = 0; problem < 1000; ++problem)
      {
        const unsigned int n = 1 + problem % 10;
        Dense              root(n, n), S(n, n);
        Small              w_0(n);
        for (unsigned int i = 0; i < n; ++i)
          {
            w_0(i) = uniform(generator);
            for (unsigned int j = 0; j < n; ++j)
              root(i, j) = uniform(generator);
          }
        root.Tmmult(S, root);
        for (unsigned int i = 0; i < n; ++i)
          S(i, i) += problem % 3 == 0 ? 1e-3 : 0.1;
        S *= scale;
        if (problem % 7 == 0)
          {
            // A degenerate node: with the forces that solve the others, its
            // opening is zero and so is its force.
            CondensedProblem others(n, [&](const auto &nodes) {
              std::vector<Small> columns;
              for (const unsigned int j : nodes)
                {
                  columns.emplace_back(n);
                  for (unsigned int i = 0; i < n; ++i)
                    columns.back()(i) = S(i, j);
                }
              return columns;
            });
            Small            g(n), w(n);
            others.solve(w_0, g);
            S.vmult(w, g);
            if (g(0) == 0.)
              w_0(0) = -w(0);
          }

        CondensedProblem lip(n, [&](const std::vector<unsigned int> &nodes) {
          std::vector<Small> columns;
          for (const unsigned int j : nodes)
            {
              columns.emplace_back(n);
              for (unsigned int i = 0; i < n; ++i)
                columns.back()(i) = S(i, j);
            }
          columns_computed += nodes.size();
          return columns;
        });
        Small            g(n);
        lip.solve(w_0, g);
        worst = std::max(worst, violation(S, w_0, g));
        rescues += lip.n_rescues();
        columns_in_all += n;
        if (n <= 8)
          worst_possible = std::max(worst_possible, best_of_all_sets(S, w_0));

        // Warm start with the solution's own set: nothing is left to do.
        if (lip.n_rescues() > 0 || problem % 7 == 0)
          continue;
        Small again(n);
        if (lip.solve(w_0, again) != 1)
          check("a warm start needs one set", false);
        again -= g;
        if (again.linfty_norm() > 1e-10 * g.linfty_norm())
          check("a warm start gives the same forces", false);
      }
    section("compliances scaled by 1e" +
            std::to_string(std::lround(std::log10(scale))));
    check_below("violation of the best of all sets", worst_possible, 1e-10);
    check_below("violation of the solution", worst, 1e-10);
    check("some cycles were met and ended", rescues > 0);
    check("columns are computed only for nodes that close",
          columns_computed < columns_in_all);
  }
} // namespace

void
condensed_problem()
{
  for (const double scale : {1., 1e12, 1e-12})
    random_problems(scale);
}
