// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

// A creeping string over a floor: the contact and the periodic layer of
// Crevasse in a program of its own.
//
// A string of a standard solid, −(q − r)'' = f(t) with ends that are held,
// creeps by ṙ = (q / 2 − r) / τ and must stay above a floor, q ≥ −0.05. It is
// pulled down and up once a period. Which r repeats?

#include <crevasse/contact/condensed_solver.h>
#include <crevasse/linear/cholesky.h>
#include <crevasse/time/anderson_acceleration.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/numbers.h>
#include <deal.II/lac/dynamic_sparsity_pattern.h>

#include <algorithm>
#include <cmath>
#include <iostream>

namespace
{
  using namespace Crevasse;

  constexpr unsigned int n_nodes = 99, n_steps = 40;
  constexpr double       floor_height = -0.05, relaxation_time = 0.3;
  constexpr double       h = 1. / (n_nodes + 1);

  /** A: linear elements of the length h. */
  SparseMatrix
  string_matrix()
  {
    dealii::DynamicSparsityPattern pattern(n_nodes, n_nodes);
    for (unsigned int i = 0; i < n_nodes; ++i)
      for (unsigned int j = i - (i > 0); j < std::min(i + 2, n_nodes); ++j)
        pattern.add(i, j);
    SparseMatrix A;
    A.reinit(pattern);
    for (unsigned int i = 0; i < n_nodes; ++i)
      for (unsigned int j = i - (i > 0); j < std::min(i + 2, n_nodes); ++j)
        A.set(i, j, (i == j ? 2. : -1.) / h);
    A.compress(dealii::VectorOperation::insert);
    return A;
  }

  /** The floor under all nodes. */
  UnilateralBounds
  bounds_of_floor()
  {
    UnilateralBounds bounds;
    for (unsigned int i = 0; i < n_nodes; ++i)
      {
        bounds.dofs.push_back(i);
        bounds.sign.push_back(1.);
        bounds.gap.push_back(floor_height);
      }
    return bounds;
  }

  class String
  {
  public:
    String()
      : A(string_matrix())
      , bounds(bounds_of_floor())
      , problem(A, bounds)
      , cholesky(A, bounds.dofs)
      , contact(problem, cholesky, 1e-10)
      , q(n_nodes)
      , b(n_nodes)
    {
    }

    /** ṙ, by one variational inequality: A q − A r − f ⟂ q ≥ floor. */
    Vector
    rate(const double t, const Vector &r)
    {
      A.vmult(b, r);
      b.add(h * (std::sin(2. * dealii::numbers::PI * t) - 0.3));
      contact.solve(b, q, forces);
      Vector rate = q;
      rate.sadd(0.5 / relaxation_time, -1. / relaxation_time, r);
      return rate;
    }

    /** r after a period, by Heun's scheme. */
    Vector
    after_a_period(const Vector &start)
    {
      constexpr double step = 1. / n_steps;
      Vector           r    = start;
      for (unsigned int k = 0; k < n_steps; ++k)
        {
          const Vector first = rate(k * step, r);
          Vector       ahead = r;
          ahead.add(step, first);
          r.add(0.5 * step, first, 0.5 * step, rate((k + 1) * step, ahead));
        }
      return r;
    }

    /** The lowest node of the last solution. */
    double
    lowest() const
    {
      return *std::min_element(q.begin(), q.end());
    }

  private:
    const SparseMatrix     A;
    const UnilateralBounds bounds;
    const SignoriniProblem problem;
    Cholesky               cholesky;
    CondensedSolver        contact;
    Vector                 q, b;
    std::vector<double>    forces;
  };
} // namespace

int
main(int argc, char **argv)
{
  const dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);

  String               string;
  AndersonAcceleration acceleration({5});
  Vector               r(n_nodes);
  for (unsigned int period = 1; period <= 100; ++period)
    {
      const Vector image  = string.after_a_period(r);
      Vector       change = image;
      change -= r;
      std::cout << "period " << period << ": r changes by "
                << change.linfty_norm() << ", lowest node " << string.lowest()
                << '\n';
      if (change.linfty_norm() < 1e-9)
        return 0;
      acceleration.add(r, image);
      acceleration.extrapolate(r);
    }
  std::cerr << "Not periodic after 100 periods.\n";
  return 1;
}
