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
      all.push_back({node.number, node.factor, node.factor, false});
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
        if ((all[i].is_on_line = share(i) > 0.))
          {
            ++n;
            matrix += share(i) * nodes[i].area *
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
            factor.is_on_line = false;
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
      if (all[i].is_on_line)
        all[i].with_line += nodes[i].sign * share(i) * (solution * line(i));
    all.erase(std::remove_if(all.begin(),
                             all.end(),
                             [](const Factor &factor) {
                               return factor.of_force == 0. &&
                                      !factor.is_on_line;
                             }),
              all.end());
  }



  LipForces::Sums
  LipForces::sums(const std::vector<double> &forces,
                  const std::vector<double> &normal) const
  {
    Sums sums;
    for (const Factor &factor : all)
      {
        sums.of_forces += factor.of_force * forces[factor.node];
        sums.with_line += factor.with_line * forces[factor.node];
        if (factor.is_on_line)
          sums.open_less_closed += normal[factor.node] > 0. ? -1. : 1.;
      }
    return sums;
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
