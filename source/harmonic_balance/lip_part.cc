// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/collectively.h>
#include <crevasse/harmonic_balance/lip_part.h>

#include <deal.II/base/mpi.h>

#include <map>

namespace Crevasse
{
  using namespace dealii;

  namespace
  {
    /** Gathers the chosen values of all ranks. */
    template <typename Number>
    void
    gather_all(const MPI_Comm                   communicator,
               const std::vector<Number>       &values,
               const std::vector<unsigned int> &chosen,
               std::vector<Number>             &all)
    {
      std::vector<Number> local;
      for (const unsigned int k : chosen)
        local.push_back(values[k]);
      all = of_all_ranks(communicator, local);
    }
  } // namespace



  LipPart::LipPart(const MPI_Comm           communicator,
                   const UnilateralBounds  &all_bounds,
                   const std::vector<bool> &chosen)
    : communicator(communicator)
    , n_bounds(all_bounds.dofs.size())
  {
    for (unsigned int k = 0; k < n_bounds; ++k)
      if (chosen[k])
        bounds.push_back(k);
    const auto counts =
      Utilities::MPI::all_gather(communicator, (unsigned int)(bounds.size()));
    for (unsigned int rank = 0;
         rank < Utilities::MPI::this_mpi_process(communicator);
         ++rank)
      first += counts[rank];
    gather_all(communicator, all_bounds.dofs, bounds, nodes.dofs);
    gather_all(communicator, all_bounds.sign, bounds, nodes.sign);
    gather_all(communicator, all_bounds.gap, bounds, nodes.gap);
  }



  dealii::Vector<double>
  LipPart::restrict_to_lip(const Vector &v) const
  {
    std::vector<double> on_bounds(n_bounds);
    for (unsigned int i = 0; i < bounds.size(); ++i)
      on_bounds[bounds[i]] = nodes.sign[first + i] * v(nodes.dofs[first + i]);
    return gather(on_bounds);
  }



  dealii::Vector<double>
  LipPart::gather(const std::vector<double> &on_bounds) const
  {
    dealii::Vector<double> on_lip(n_nodes());
    for (unsigned int i = 0; i < bounds.size(); ++i)
      on_lip(first + i) = on_bounds[bounds[i]];
    // Entries of other ranks are zero here, so the sum has no rounding.
    if (n_nodes() > 0)
      Utilities::MPI::sum(on_lip, communicator, on_lip);
    return on_lip;
  }



  std::vector<double>
  LipPart::scatter(const dealii::Vector<double> &on_lip) const
  {
    std::vector<double> on_bounds(n_bounds, 0.);
    for (unsigned int i = 0; i < bounds.size(); ++i)
      on_bounds[bounds[i]] = on_lip(first + i);
    return on_bounds;
  }



  void
  LipPart::add_forces(const double                  factor,
                      const dealii::Vector<double> &forces,
                      Vector                       &v) const
  {
    for (unsigned int i = first; i < first + bounds.size(); ++i)
      v(nodes.dofs[i]) += factor * nodes.sign[i] * forces(i);
  }



  FullMatrix<double>
  LipPart::compliance(LinearSolver &linear_solver, const Vector &model) const
  {
    const auto *const  factor = dynamic_cast<DirectSolver *>(&linear_solver);
    FullMatrix<double> matrix = factor != nullptr && !factor->lip.empty()
                                  ? from_factor(*factor)
                                  : from_columns(linear_solver, model);
    matrix.symmetrize();
    return matrix;
  }



  FullMatrix<double>
  LipPart::from_factor(const DirectSolver &factor) const
  {
    LAPACKFullMatrix<double> inverse(factor.lip_stiffness());
    inverse.set_property(LAPACKSupport::symmetric);
    inverse.compute_cholesky_factorization();
    inverse.invert();
    std::map<types::global_dof_index, unsigned int> place;
    for (unsigned int i = 0; i < factor.lip.size(); ++i)
      place[factor.lip[i]] = i;
    const unsigned int n = n_nodes();
    FullMatrix<double> matrix(n, n);
    for (unsigned int i = 0; i < n; ++i)
      for (unsigned int j = 0; j < n; ++j)
        matrix(i, j) =
          nodes.sign[i] * nodes.sign[j] *
          inverse(place.at(nodes.dofs[i]), place.at(nodes.dofs[j]));
    return matrix;
  }



  FullMatrix<double>
  LipPart::from_columns(LinearSolver &linear_solver, const Vector &model) const
  {
    constexpr double       residual_norm = 1e-12; // for unit forces
    const unsigned int     n             = n_nodes();
    FullMatrix<double>     matrix(n, n);
    dealii::Vector<double> unit(n);
    Vector                 forces(model), displacement(model);
    for (unsigned int k = 0; k < n; ++k)
      {
        unit         = 0.;
        unit(k)      = 1.;
        forces       = 0.;
        displacement = 0.;
        add_forces(1., unit, forces);
        linear_solver.solve(displacement, forces, residual_norm);
        const dealii::Vector<double> column = restrict_to_lip(displacement);
        for (unsigned int i = 0; i < n; ++i)
          matrix(i, k) = column(i);
      }
    return matrix;
  }
} // namespace Crevasse
