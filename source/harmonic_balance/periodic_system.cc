// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/problems.h>
#include <crevasse/harmonic_balance/periodic_system.h>

#include <deal.II/base/exceptions.h>
#include <deal.II/lac/precondition.h>
#include <deal.II/lac/solver_control.h>
#include <deal.II/lac/solver_gmres.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace Crevasse
{
  using namespace dealii;

  namespace
  {
    NumericalError
    singular(const unsigned int n_unknowns)
    {
      return NumericalError(
        "The compliance of the crack lip is singular for " +
        std::to_string(n_unknowns) +
        " closed nodes and instants: check the moduli of [Material] for "
        "extreme contrasts, or try [Periodic state] Method = anderson.");
    }
  } // namespace



  PeriodicSystem::PeriodicSystem(const PeriodicConvolution &convolution,
                                 const unsigned int largest_dense_system,
                                 const unsigned int most_steps)
    : convolution(convolution)
    , largest_dense_system(largest_dense_system)
    , most_steps(most_steps)
    , preconditioner(convolution)
  {
  }



  void
  PeriodicSystem::reinit(const std::vector<bool>      &active,
                         const dealii::Vector<double> &new_diagonal)
  {
    const unsigned int p = convolution.n_nodes();
    AssertDimension(active.size(), p * convolution.n_instants());
    AssertDimension(new_diagonal.size(), active.size());
    diagonal = new_diagonal;
    unknowns.clear();
    for (unsigned int k = 0; k < active.size(); ++k)
      if (active[k])
        unknowns.push_back(k);
    const unsigned int size = unknowns.size() + p;
    largest                 = std::max(largest, size);
    try
      {
        if (size <= largest_dense_system)
          factor();
        else
          {
            matrix.reinit(0);
            preconditioner.reinit(active, diagonal);
          }
      }
    catch (const ExceptionBase &)
      {
        throw singular(unknowns.size());
      }
  }



  void
  PeriodicSystem::factor()
  {
    const unsigned int p = convolution.n_nodes();
    const unsigned int N = convolution.n_instants();
    const unsigned int m = unknowns.size();
    if (kernel.empty())
      kernel = convolution.definite_kernel();

    // With ones on the diagonal, the pivots are comparable whatever the units
    // and however much D varies.
    scaling.reinit(m + p);
    for (unsigned int a = 0; a < m; ++a)
      {
        const unsigned int i     = unknowns[a] % p;
        const double       entry = diagonal(unknowns[a]) + kernel[0](i, i);
        if (!(entry > 0.))
          throw singular(m);
        scaling(a)     = 1. / std::sqrt(entry);
        scaling(m + i) = std::max(scaling(m + i), scaling(a));
      }
    for (unsigned int i = 0; i < p; ++i)
      scaling(m + i) = 1. / scaling(m + i);

    matrix.reinit(m + p);
    matrix = 0.;
    for (unsigned int b = 0; b < m; ++b)
      {
        const unsigned int l = unknowns[b] % p, t_k = unknowns[b] / p;
        for (unsigned int a = 0; a < m; ++a)
          {
            const unsigned int i = unknowns[a] % p, t_j = unknowns[a] / p;
            const double       entry = kernel[(N + t_j - t_k) % N](i, l);
            matrix(a, b)             = scaling(a) * scaling(b) * entry;
          }
        matrix(b, b) += scaling(b) * scaling(b) * diagonal(unknowns[b]);
        matrix(b, m + l) = scaling(b) * scaling(m + l);
        matrix(m + l, b) = matrix(b, m + l);
      }
    matrix.compute_lu_factorization();
  }



  void
  PeriodicSystem::solve(const dealii::Vector<double> &right,
                        const dealii::Vector<double> &means,
                        const double                  accuracy,
                        dealii::Vector<double>       &x,
                        dealii::Vector<double>       &offsets)
  {
    ++solves;
    const bool iteratively =
      matrix.m() == 0 && solve_iteratively(right, means, accuracy, x, offsets);
    if (!iteratively)
      {
        if (matrix.m() == 0)
          factor_after_all();
        solve_dense(right, means, x, offsets);
      }
    for (const double entry : x)
      if (!std::isfinite(entry))
        throw singular(unknowns.size());
  }



  void
  PeriodicSystem::factor_after_all()
  {
    // About 300 MB, and ten seconds.
    constexpr unsigned int largest_factor = 6000;
    if (unknowns.size() > largest_factor)
      throw NumericalError(
        "The equations of " + std::to_string(unknowns.size()) +
        " closed nodes and instants did not converge by GMRES: the "
        "relaxation times and the period are too far apart. Try fewer "
        "instants, or [Periodic state] Method = anderson.");
    try
      {
        factor();
      }
    catch (const ExceptionBase &)
      {
        throw singular(unknowns.size());
      }
  }



  void
  PeriodicSystem::solve_dense(const dealii::Vector<double> &right,
                              const dealii::Vector<double> &means,
                              dealii::Vector<double>       &x,
                              dealii::Vector<double>       &offsets) const
  {
    const unsigned int     p = convolution.n_nodes();
    const unsigned int     m = unknowns.size();
    dealii::Vector<double> solution(m + p);
    for (unsigned int a = 0; a < m; ++a)
      solution(a) = right(unknowns[a]);
    for (unsigned int i = 0; i < p; ++i)
      solution(m + i) = convolution.n_instants() * means(i);
    solution.scale(scaling);
    matrix.solve(solution);
    solution.scale(scaling);

    x.reinit(right.size());
    for (unsigned int a = 0; a < m; ++a)
      x(unknowns[a]) = solution(a);
    // The kernel's harmonic 0, which the convolution does not have, has added
    // a constant.
    offsets.reinit(p);
    convolution.elastic_compliance().vmult(offsets, means);
    for (unsigned int i = 0; i < p; ++i)
      offsets(i) += solution(m + i);
  }



  namespace
  {
    /** The system with its preconditioner on the right and nothing left of the
     * border: the unknown is the right-hand side of the preconditioner. */
    struct Preconditioned
    {
      Preconditioned(const PeriodicConvolution           &convolution,
                     const PeriodicElasticPreconditioner &preconditioner,
                     const std::vector<unsigned int>     &unknowns,
                     const dealii::Vector<double>        &diagonal)
        : convolution(convolution)
        , preconditioner(preconditioner)
        , unknowns(unknowns)
        , diagonal(diagonal)
        , no_means(convolution.n_nodes())
        , right(diagonal.size())
      {
      }

      void
      vmult(dealii::Vector<double>       &result,
            const dealii::Vector<double> &y) const
      {
        const unsigned int p = convolution.n_nodes();
        for (unsigned int a = 0; a < unknowns.size(); ++a)
          right(unknowns[a]) = y(a);
        preconditioner.solve(right, no_means, x, offsets);
        convolution.vmult(Sx, x);
        for (unsigned int a = 0; a < unknowns.size(); ++a)
          {
            const unsigned int k = unknowns[a];
            result(a)            = diagonal(k) * x(k) + Sx(k) + offsets(k % p);
          }
      }

      const PeriodicConvolution           &convolution;
      const PeriodicElasticPreconditioner &preconditioner;
      const std::vector<unsigned int>     &unknowns;
      const dealii::Vector<double>        &diagonal;

      const dealii::Vector<double>   no_means;
      mutable dealii::Vector<double> right, x, Sx, offsets;
    };
  } // namespace



  bool
  PeriodicSystem::solve_iteratively(const dealii::Vector<double> &right,
                                    const dealii::Vector<double> &means,
                                    const double                  accuracy,
                                    dealii::Vector<double>       &x,
                                    dealii::Vector<double>       &offsets)
  {
    const unsigned int p = convolution.n_nodes();
    const unsigned int m = unknowns.size();

    // A first approximation has the right mean; the rest has none.
    preconditioner.solve(right, means, x, offsets);
    dealii::Vector<double> Sx(right.size()), rest(m), y(m);
    convolution.vmult(Sx, x);
    for (unsigned int a = 0; a < m; ++a)
      {
        const unsigned int k = unknowns[a];
        rest(a) = right(k) - diagonal(k) * x(k) - Sx(k) - offsets(k % p);
      }
    constexpr unsigned int most_vectors = 500;
    SolverControl          control(most_steps, accuracy * std::sqrt(m));
    SolverGMRES<dealii::Vector<double>> gmres(
      control,
      SolverGMRES<dealii::Vector<double>>::AdditionalData(most_vectors));
    const Preconditioned system(convolution,
                                preconditioner,
                                unknowns,
                                diagonal);
    try
      {
        gmres.solve(system, y, rest, PreconditionIdentity());
      }
    catch (const SolverControl::NoConvergence &)
      {
        iterations += control.last_step();
        return false;
      }
    iterations += control.last_step();

    dealii::Vector<double> all(right.size()), x_rest, offsets_rest;
    for (unsigned int a = 0; a < m; ++a)
      all(unknowns[a]) = y(a);
    preconditioner.solve(all, system.no_means, x_rest, offsets_rest);
    x += x_rest;
    offsets += offsets_rest;
    return true;
  }
} // namespace Crevasse
