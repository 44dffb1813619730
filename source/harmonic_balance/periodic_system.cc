// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/problems.h>
#include <crevasse/harmonic_balance/periodic_system.h>

#include <deal.II/base/exceptions.h>
#include <deal.II/lac/solver_control.h>
#include <deal.II/lac/solver_gmres.h>

#include <algorithm>
#include <cmath>

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



  PeriodicSystem::PeriodicSystem(const PeriodicConvolution    &convolution,
                                 const PeriodicContactOptions &options)
    : convolution(convolution)
    , options(options)
    , n_offsets(convolution.has_mean ? 0 : convolution.n_nodes)
    , preconditioner(*this)
  {
  }



  void
  PeriodicSystem::reinit(const std::vector<bool> &active,
                         const double             new_shift)
  {
    shift                = new_shift;
    const unsigned int p = convolution.n_nodes;
    unknowns.clear();
    begins.clear();
    for (unsigned int k = 0; k < active.size(); ++k)
      {
        if (k % p == 0)
          begins.push_back(unknowns.size());
        if (active[k])
          unknowns.push_back(k);
      }
    begins.push_back(unknowns.size());
    all_entries.reinit(active.size());
    matrix.reinit(0);
    if (unknowns.empty())
      return;
    try
      {
        if (unknowns.size() + n_offsets <= options.largest_dense_system)
          factor();
        else
          prepare_preconditioner();
      }
    catch (const ExceptionBase &)
      {
        throw singular(unknowns.size());
      }
  }



  void
  PeriodicSystem::factor()
  {
    const unsigned int p = convolution.n_nodes, N = convolution.n_instants;
    const unsigned int m = unknowns.size();
    if (kernel.empty())
      kernel = convolution.kernel();

    // Scaled to a unit diagonal, pivots are comparable whatever the units.
    scaling.reinit(m + n_offsets);
    for (unsigned int a = 0; a < m; ++a)
      {
        const unsigned int i = unknowns[a] % p;
        scaling(a)           = 1. / std::sqrt(shift + kernel[0](i, i));
        if (n_offsets > 0)
          scaling(m + i) = 1. / scaling(a);
      }
    matrix.reinit(m + n_offsets);
    matrix = 0.;
    for (unsigned int b = 0; b < m; ++b)
      {
        const unsigned int l = unknowns[b] % p, t_k = unknowns[b] / p;
        for (unsigned int a = 0; a < m; ++a)
          {
            const unsigned int i = unknowns[a] % p, t_j = unknowns[a] / p;
            matrix(a, b) =
              scaling(a) * scaling(b) * kernel[(N + t_j - t_k) % N](i, l);
          }
        matrix(b, b) += scaling(b) * scaling(b) * shift;
        if (n_offsets > 0)
          matrix(b, m + l) = matrix(m + l, b) = 1.; // scaled
      }
    matrix.compute_lu_factorization();
  }



  void
  PeriodicSystem::prepare_preconditioner()
  {
    const unsigned int        p       = convolution.n_nodes;
    const FullMatrix<double> &elastic = convolution.elastic_compliance;
    LAPACKFullMatrix<double> &border  = preconditioner.border;
    border.reinit(n_offsets);
    border.set_property(LAPACKSupport::symmetric);
    border = 0.;
    preconditioner.inverses.resize(convolution.n_instants);
    for (unsigned int j = 0; j < convolution.n_instants; ++j)
      {
        const auto node = [&](const unsigned int a) {
          return unknowns[begins[j] + a] % p;
        };
        const unsigned int m = begins[j + 1] - begins[j];
        if (m == 0)
          continue;
        LAPACKFullMatrix<double> &inverse = preconditioner.inverses[j];
        inverse.reinit(m);
        inverse.set_property(LAPACKSupport::symmetric);
        for (unsigned int b = 0; b < m; ++b)
          for (unsigned int a = 0; a < m; ++a)
            inverse(a, b) = elastic(node(a), node(b)) + (a == b ? shift : 0.);
        inverse.compute_cholesky_factorization();
        inverse.invert();
        // Schur complement for c after elimination of x: Σ over the instants.
        for (unsigned int b = 0; b < m && n_offsets > 0; ++b)
          for (unsigned int a = 0; a < m; ++a)
            border(node(a), node(b)) += inverse(a, b);
      }
    if (n_offsets > 0)
      border.compute_cholesky_factorization();
  }



  void
  PeriodicSystem::Preconditioner::vmult(LipVector       &x_and_c,
                                        const LipVector &right) const
  {
    const unsigned int p = system.convolution.n_nodes;
    const unsigned int m = system.unknowns.size();
    // First solve without offsets; the missing mean determines the offsets.
    const unsigned int n_offsets = system.n_offsets;
    offsets.reinit(n_offsets, true);
    for (unsigned int i = 0; i < n_offsets; ++i)
      offsets(i) = -right(m + i);
    x_and_c = 0.;
    for (const bool with_offsets : {false, true})
      {
        for (unsigned int j = 0; j < inverses.size(); ++j)
          if (const unsigned int begin = system.begins[j],
              n                        = system.begins[j + 1] - begin;
              n > 0)
            {
              before.reinit(n, true);
              after.reinit(n, true);
              for (unsigned int a = 0; a < n; ++a)
                before(a) = with_offsets
                              ? -offsets(system.unknowns[begin + a] % p)
                              : right(begin + a);
              inverses[j].vmult(after, before);
              for (unsigned int a = 0; a < n; ++a)
                x_and_c(begin + a) += after(a);
            }
        if (with_offsets || n_offsets == 0)
          break;
        for (unsigned int a = 0; a < m; ++a)
          offsets(system.unknowns[a] % p) += x_and_c(a);
        border.solve(offsets);
      }
    std::copy(offsets.begin(), offsets.end(), x_and_c.begin() + m);
  }



  void
  PeriodicSystem::vmult(LipVector &result, const LipVector &x_and_c) const
  {
    const unsigned int p = convolution.n_nodes, m = unknowns.size();
    for (unsigned int a = 0; a < m; ++a)
      all_entries(unknowns[a]) = x_and_c(a);
    convolution.vmult(convolved, all_entries);
    result = 0.;
    for (unsigned int a = 0; a < m; ++a)
      result(a) = convolved(unknowns[a]) + shift * x_and_c(a) +
                  (n_offsets > 0 ? x_and_c(m + unknowns[a] % p) : 0.);
  }



  bool
  PeriodicSystem::solve_iteratively(const LipVector &right,
                                    const double     accuracy,
                                    LipVector       &x_and_c)
  {
    const unsigned int m = unknowns.size();
    LipVector          equations(right);
    std::fill(equations.begin() + m, equations.end(), 0.);
    preconditioner.vmult(x_and_c, right);
    constexpr unsigned int most_vectors = 500;
    SolverControl control(options.most_gmres_steps, accuracy * std::sqrt(m));
    SolverGMRES<LipVector> gmres(
      control, SolverGMRES<LipVector>::AdditionalData(most_vectors, true));
    bool converged = true;
    try
      {
        gmres.solve(*this, x_and_c, equations, preconditioner);
      }
    catch (const SolverControl::NoConvergence &)
      {
        converged = false;
      }
    n_iterations += control.last_step();
    return converged;
  }



  void
  PeriodicSystem::solve(const LipVector &right,
                        const LipVector &means,
                        const double     accuracy,
                        LipVector       &x,
                        LipVector       &offsets)
  {
    const unsigned int p = convolution.n_nodes, m = unknowns.size();
    LipVector          b(m + n_offsets), solution(m + n_offsets);
    x.reinit(right.size());
    offsets.reinit(p);
    if (m == 0)
      return;
    for (unsigned int a = 0; a < m; ++a)
      b(a) = right(unknowns[a]);
    for (unsigned int i = 0; i < n_offsets; ++i)
      b(m + i) = convolution.n_instants * means(i);
    if (matrix.m() > 0 || !solve_iteratively(b, accuracy, solution))
      {
        // A factor of this size takes about 300 MB and ten seconds.
        constexpr unsigned int largest_factor = 6000;
        if (m > largest_factor)
          throw NumericalError(
            "GMRES for " + std::to_string(m) +
            " closed nodes and instants did not converge: the relaxation times "
            "and the period are too far apart. Use fewer [Time integration] "
            "Steps per period, or [Periodic state] Method = anderson.");
        try
          {
            if (matrix.m() == 0)
              factor();
            solution = b;
            solution.scale(scaling);
            matrix.solve(solution);
            solution.scale(scaling);
          }
        catch (const ExceptionBase &)
          {
            throw singular(m);
          }
      }
    if (!std::isfinite(solution.l1_norm()))
      throw singular(m);
    for (unsigned int a = 0; a < m; ++a)
      x(unknowns[a]) = solution(a);
    std::copy(solution.begin() + m, solution.end(), offsets.begin());
  }
} // namespace Crevasse
