// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/crack_tip/lip_forces.h>

#include <deal.II/base/symmetric_tensor.h>

#include <algorithm>

namespace Crevasse
{
  using namespace dealii;

  LipForces::LipForces(const std::vector<Node> &nodes)
  {
    for (const Node &node : nodes)
      all.push_back({node.number, node.factor, node.factor, 0., node.area});
  }



  LipForces::LipForces(const std::vector<Node> &nodes,
                       const double             begin,
                       const double             reach,
                       const MPI_Comm           communicator)
    : LipForces(nodes)
  {
    double                end = 3.5 * begin;
    SymmetricTensor<2, 2> matrix; // of the least squares
    const auto            line = [&](const std::size_t i) {
      return Tensor<1, 2>({1., nodes[i].distance});
    };
    const auto share = [&](const std::size_t i) {
      const bool is_between =
        nodes[i].distance > begin && nodes[i].distance < end;
      return is_between ? std::max(0., 1. - nodes[i].along / end) : 0.;
    };
    const auto fit_until_end = [&]() {
      matrix         = 0.;
      unsigned int n = 0;
      for (std::size_t i = 0; i < nodes.size(); ++i)
        if ((all[i].share = share(i)) > 0.)
          {
            ++n;
            matrix += all[i].share * nodes[i].area *
                      symmetrize(outer_product(line(i), line(i)));
          }
      matrix = Utilities::MPI::sum(matrix, communicator);
      // The distances of few nodes, or of one row along a front, are alike.
      const double     mean   = matrix[0][1] / matrix[0][0];
      const double     square = matrix[1][1] / matrix[0][0] - mean * mean;
      constexpr double part   = 0.15;
      return Utilities::MPI::sum(n, communicator) >= 4 &&
             square > part * part * begin * begin;
    };
    while (!fit_until_end())
      if ((end *= 1.5) > reach)
        {
          for (Factor &factor : all)
            factor.share = 0.;
          return;
        }

    Tensor<1, 2> of_coefficients;
    for (std::size_t i = 0; i < nodes.size(); ++i)
      if (nodes[i].distance <= begin)
        {
          of_coefficients +=
            nodes[i].sign * nodes[i].factor * nodes[i].area * line(i);
          all[i].with_line = 0.;
        }
    of_coefficients = Utilities::MPI::sum(of_coefficients, communicator);
    const Tensor<1, 2> solution = invert(matrix) * of_coefficients;
    for (std::size_t i = 0; i < nodes.size(); ++i)
      if (all[i].share > 0.)
        all[i].with_line += nodes[i].sign * all[i].share * (solution * line(i));
  }



  double
  LipForces::chosen(const Sums &sums)
  {
    if (!(sums[square] > 0.))
      return sums[of_forces];
    // 1 for a uniform pressure, 3/4 for one that rises from 0, 1/2 for one on
    // half of the line.
    const double evenness =
      sums[pressure] * sums[pressure] / (sums[area] * sums[square]);
    constexpr double none = 0.5, all = 0.7;
    const double part = std::clamp((evenness - none) / (all - none), 0., 1.);
    return sums[of_forces] + part * (sums[with_line] - sums[of_forces]);
  }



  void
  LipForces::add(const std::vector<double> &forces,
                 const std::vector<double> &normal,
                 Sums                      &sums) const
  {
    for (const Factor &factor : all)
      {
        sums[of_forces] += factor.of_force * forces[factor.node];
        sums[with_line] += factor.with_line * forces[factor.node];
        if (factor.share > 0.)
          {
            const double g = std::max(0., normal[factor.node]);
            sums[area] += factor.share * factor.area;
            sums[pressure] += factor.share * g;
            sums[square] += factor.share * g * g / factor.area;
          }
      }
  }



  void
  LipForces::scale(const double factor)
  {
    for (Factor &one : all)
      {
        one.of_force *= factor;
        one.with_line *= factor;
      }
  }



  std::vector<double>
  LipForces::factors(const std::size_t n_nodes) const
  {
    std::vector<double> factors(n_nodes);
    for (const Factor &factor : all)
      factors[factor.node] = factor.with_line;
    return factors;
  }
} // namespace Crevasse
