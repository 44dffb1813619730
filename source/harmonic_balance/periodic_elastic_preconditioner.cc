// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/harmonic_balance/periodic_elastic_preconditioner.h>

#include <deal.II/base/exceptions.h>

namespace Crevasse
{
  using namespace dealii;

  PeriodicElasticPreconditioner::PeriodicElasticPreconditioner(
    const PeriodicConvolution &convolution)
    : convolution(convolution)
    , nodes(convolution.n_instants())
    , inverses(convolution.n_instants())
  {
  }



  void
  PeriodicElasticPreconditioner::reinit(const std::vector<bool>      &active,
                                        const dealii::Vector<double> &diagonal)
  {
    const unsigned int        p       = convolution.n_nodes();
    const FullMatrix<double> &elastic = convolution.elastic_compliance();
    border.reinit(p);
    border.set_property(LAPACKSupport::symmetric);
    border = 0.;
    for (unsigned int j = 0; j < nodes.size(); ++j)
      {
        nodes[j].clear();
        for (unsigned int i = 0; i < p; ++i)
          if (active[j * p + i])
            nodes[j].push_back(i);
        const unsigned int m = nodes[j].size();
        if (m == 0)
          continue;
        LAPACKFullMatrix<double> &inverse = inverses[j];
        inverse.reinit(m);
        inverse.set_property(LAPACKSupport::symmetric);
        for (unsigned int b = 0; b < m; ++b)
          for (unsigned int a = 0; a < m; ++a)
            inverse(a, b) = elastic(nodes[j][a], nodes[j][b]) +
                            (a == b ? diagonal(j * p + nodes[j][a]) : 0.);
        inverse.compute_cholesky_factorization();
        inverse.invert();
        // What eliminates x leaves for c: Σ over the instants.
        for (unsigned int b = 0; b < m; ++b)
          for (unsigned int a = 0; a < m; ++a)
            border(nodes[j][a], nodes[j][b]) += inverse(a, b);
      }
    border.compute_cholesky_factorization();
  }



  void
  PeriodicElasticPreconditioner::solve(const dealii::Vector<double> &right,
                                       const dealii::Vector<double> &means,
                                       dealii::Vector<double>       &x,
                                       dealii::Vector<double> &offsets) const
  {
    const unsigned int p = convolution.n_nodes();
    const unsigned int N = convolution.n_instants();
    x.reinit(p * N);

    // First without offsets; what the mean then lacks asks for them.
    dealii::Vector<double> before, after;
    const auto add_inverse = [&](const unsigned int j, const auto &right_at) {
      const unsigned int m = nodes[j].size();
      if (m == 0)
        return;
      before.reinit(m, true);
      after.reinit(m, true);
      for (unsigned int a = 0; a < m; ++a)
        before(a) = right_at(nodes[j][a]);
      inverses[j].vmult(after, before);
      for (unsigned int a = 0; a < m; ++a)
        x(j * p + nodes[j][a]) += after(a);
    };
    for (unsigned int j = 0; j < N; ++j)
      add_inverse(j, [&](const unsigned int i) { return right(j * p + i); });

    offsets.reinit(p);
    offsets.add(-1. * N, means);
    for (unsigned int k = 0; k < p * N; ++k)
      offsets(k % p) += x(k);
    border.solve(offsets);
    for (unsigned int j = 0; j < N; ++j)
      add_inverse(j, [&](const unsigned int i) { return -offsets(i); });
  }
} // namespace Crevasse
