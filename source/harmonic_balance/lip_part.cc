// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/harmonic_balance/lip_part.h>

#include <deal.II/base/mpi.h>

#include <algorithm>

namespace Crevasse
{
  using namespace dealii;

  namespace
  {
    template <typename Number>
    std::vector<Number>
    concatenate(const MPI_Comm communicator, const std::vector<Number> &local)
    {
      std::vector<Number> all;
      for (const auto &part : Utilities::MPI::all_gather(communicator, local))
        all.insert(all.end(), part.begin(), part.end());
      return all;
    }
  } // namespace



  LipPart::LipPart(const MPI_Comm           communicator,
                   const UnilateralBounds  &all_bounds,
                   const std::vector<bool> &chosen)
    : communicator(communicator)
    , n_bounds(all_bounds.dofs.size())
  {
    UnilateralBounds local;
    for (unsigned int k = 0; k < n_bounds; ++k)
      if (chosen[k])
        {
          bounds.push_back(k);
          local.dofs.push_back(all_bounds.dofs[k]);
          local.sign.push_back(all_bounds.sign[k]);
          local.gap.push_back(all_bounds.gap[k]);
        }
    const auto counts =
      Utilities::MPI::all_gather(communicator, (unsigned int)(bounds.size()));
    for (unsigned int rank = 0;
         rank < Utilities::MPI::this_mpi_process(communicator);
         ++rank)
      first += counts[rank];
    node_dofs  = concatenate(communicator, local.dofs);
    node_signs = concatenate(communicator, local.sign);
    node_gaps  = concatenate(communicator, local.gap);
  }



  template <typename Function>
  void
  LipPart::for_each_local(const Function &f) const
  {
    for (unsigned int i = 0; i < bounds.size(); ++i)
      f(first + i, bounds[i]);
  }



  dealii::Vector<double>
  LipPart::of_all_ranks(dealii::Vector<double> &&local) const
  {
    // What a rank does not own is zero there: the sum rounds nothing.
    if (n_nodes() > 0)
      Utilities::MPI::sum(local, communicator, local);
    return std::move(local);
  }



  dealii::Vector<double>
  LipPart::restrict_to_lip(const Vector &v) const
  {
    dealii::Vector<double> on_lip(n_nodes());
    for_each_local([&](const unsigned int node, const unsigned int) {
      on_lip(node) = node_signs[node] * v(node_dofs[node]);
    });
    return of_all_ranks(std::move(on_lip));
  }



  dealii::Vector<double>
  LipPart::gather(const std::vector<double> &on_bounds) const
  {
    dealii::Vector<double> on_lip(n_nodes());
    for_each_local([&](const unsigned int node, const unsigned int bound) {
      on_lip(node) = on_bounds[bound];
    });
    return of_all_ranks(std::move(on_lip));
  }



  std::vector<double>
  LipPart::scatter(const dealii::Vector<double> &on_lip) const
  {
    std::vector<double> on_bounds(n_bounds, 0.);
    for_each_local([&](const unsigned int node, const unsigned int bound) {
      on_bounds[bound] = on_lip(node);
    });
    return on_bounds;
  }



  void
  LipPart::add_forces(const double                  factor,
                      const dealii::Vector<double> &forces,
                      Vector                       &v) const
  {
    for_each_local([&](const unsigned int node, const unsigned int) {
      v(node_dofs[node]) += factor * node_signs[node] * forces(node);
    });
  }



  void
  LipPart::prescribe(const dealii::Vector<double> &on_lip, Vector &v) const
  {
    for_each_local([&](const unsigned int node, const unsigned int) {
      v(node_dofs[node]) = node_signs[node] * on_lip(node);
    });
  }



  FullMatrix<double>
  LipPart::compliance(LinearSolver &linear_solver, const Vector &model) const
  {
    // A dense block of right-hand sides is what limits the memory.
    constexpr unsigned int block_size    = 32;
    constexpr double       residual_norm = 1e-12; // of unit forces
    const unsigned int     n             = n_nodes();
    FullMatrix<double>     matrix(n, n);
    for (unsigned int begin = 0; begin < n; begin += block_size)
      {
        const unsigned int  m = std::min(block_size, n - begin);
        std::vector<Vector> columns(m, model);
        for (unsigned int k = 0; k < m; ++k)
          {
            dealii::Vector<double> unit(n);
            unit(begin + k) = 1.;
            columns[k]      = 0.;
            add_forces(1., unit, columns[k]);
          }
        linear_solver.solve(columns, residual_norm);
        for (unsigned int k = 0; k < m; ++k)
          {
            const dealii::Vector<double> column = restrict_to_lip(columns[k]);
            for (unsigned int i = 0; i < n; ++i)
              matrix(i, begin + k) = column(i);
          }
      }
    matrix.symmetrize();
    return matrix;
  }
} // namespace Crevasse
