// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_tests_random_problem_h
#define crevasse_tests_random_problem_h

#include <crevasse/contact/signorini_problem.h>

#include <deal.II/lac/dynamic_sparsity_pattern.h>
#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/lapack_full_matrix.h>

#include <cmath>
#include <random>

/** A random symmetric positive definite contact problem (seeded), small enough
 * to try every active set. The first unknown has no bound if there are fewer
 * bounds than unknowns; signs alternate, some gaps are negative. The smaller
 * the @p regularisation, the worse the condition may be. */
class RandomProblem
{
public:
  RandomProblem(const unsigned int seed,
                const unsigned int n,
                const unsigned int n_bounds,
                const double       scale,
                const double       regularisation = 0.1)
    : b(n)
    , dense(n, n)
  {
    std::mt19937                           generator(seed);
    std::uniform_real_distribution<double> uniform(-1., 1.);
    dealii::FullMatrix<double>             root(n, n);
    for (unsigned int i = 0; i < n; ++i)
      {
        b(i) = uniform(generator) * scale;
        for (unsigned int j = 0; j < n; ++j)
          root(i, j) = uniform(generator);
      }
    root.Tmmult(dense, root);
    for (unsigned int i = 0; i < n; ++i)
      dense(i, i) += regularisation;
    dense *= scale;
    for (unsigned int k = 0; k < n_bounds; ++k)
      {
        bounds.dofs.push_back(n - n_bounds + k);
        bounds.sign.push_back(k % 2 == 0 ? 1. : -1.);
        bounds.gap.push_back(k % 2 == 0 ? 0.
                                        : -0.1 * std::abs(uniform(generator)));
      }

    dealii::DynamicSparsityPattern pattern(n, n);
    for (unsigned int i = 0; i < n; ++i)
      for (unsigned int j = 0; j < n; ++j)
        pattern.add(i, j);
    matrix.reinit(pattern);
    for (unsigned int i = 0; i < n; ++i)
      for (unsigned int j = 0; j < n; ++j)
        matrix.set(i, j, dense(i, j));
    matrix.compress(dealii::VectorOperation::insert);
  }

  /** Makes a bound degenerate: with the solution @p q and its forces, neither
   * force nor opening is left there. */
  void
  make_degenerate(const unsigned int k, const Crevasse::Vector &q)
  {
    const auto i   = bounds.dofs[k];
    bounds.gap[k]  = bounds.sign[k] * q(i);
    double product = 0.;
    for (unsigned int j = 0; j < b.size(); ++j)
      product += dense(i, j) * q(j);
    b(i) = product;
  }

  /** Solves with the bounds in the bit set @p active as equations, the others
   * ignored. */
  Crevasse::Vector
  solve_with(const unsigned int active) const
  {
    const unsigned int               n = b.size();
    dealii::LAPACKFullMatrix<double> system(n);
    dealii::Vector<double>           x(n);
    system = dense;
    for (unsigned int i = 0; i < n; ++i)
      x(i) = b(i);
    for (unsigned int k = 0; k < bounds.dofs.size(); ++k)
      if ((active >> k) & 1)
        {
          const auto i = bounds.dofs[k];
          for (unsigned int j = 0; j < n; ++j)
            system(i, j) = (i == j ? 1. : 0.);
          x(i) = bounds.sign[k] * bounds.gap[k];
        }
    system.compute_lu_factorization();
    system.solve(x);
    Crevasse::Vector solution(n);
    for (unsigned int i = 0; i < n; ++i)
      solution(i) = x(i);
    return solution;
  }

  /** How far @p q is from satisfying complementarity. */
  double
  violation(const Crevasse::Vector &q) const
  {
    double worst = 0.;
    for (unsigned int k = 0; k < bounds.dofs.size(); ++k)
      {
        const auto i     = bounds.dofs[k];
        double     force = -b(i);
        for (unsigned int j = 0; j < b.size(); ++j)
          force += dense(i, j) * q(j);
        const double g = bounds.sign[k] * force / b.linfty_norm();
        const double w =
          (bounds.sign[k] * q(i) - bounds.gap[k]) / q.linfty_norm();
        worst = std::max(worst, std::abs(std::min(g, w)));
      }
    return worst;
  }

  /** The solution, by trying every active set. */
  Crevasse::Vector
  solution_by_enumeration() const
  {
    Crevasse::Vector best;
    double           least = 1e300;
    for (unsigned int active = 0; active < (1u << bounds.dofs.size()); ++active)
      {
        const Crevasse::Vector candidate = solve_with(active);
        const double           here      = violation(candidate);
        if (here < least)
          {
            least = here;
            best  = candidate;
          }
      }
    return best;
  }

  Crevasse::SparseMatrix     matrix;
  Crevasse::UnilateralBounds bounds;
  Crevasse::Vector           b;

private:
  dealii::FullMatrix<double> dense;
};

#endif
