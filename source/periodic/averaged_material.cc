// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/periodic/averaged_material.h>

namespace Crevasse
{
  using namespace dealii;

  template <int dim>
  AveragedMaterial<dim>::AveragedMaterial(const Body<dim>         &body,
                                          const Stages            &stages,
                                          ContactSystemCache<dim> &instants,
                                          const StressHistory     &stresses)
    : state(instants.material_at(stages.instants.front()))
  {
    using Field                   = QuadratureField<dim>;
    using Values                  = std::vector<VoigtMatrix<dim>>;
    const bool          is_linear = body.law.creep == nullptr;
    const std::size_t   n         = body.points.n_local_points;
    Values              K(n);
    std::vector<Values> H(state.fluidity.size(), Values(n));
    std::vector<double> flow(n);
    for (unsigned int j = 0; j < stages.instants.size(); ++j)
      {
        const MaterialState<dim> &now =
          instants.material_at(stages.instants[j]);
        const double  weight = now.kappa(stages.weights[j]);
        const Vector *stress =
          is_linear ? nullptr : &stresses.at(stages.instants[j]);
        largest_factor = std::max(largest_factor, now.stiffness_factor);
        shares.emplace_back(n);
        for (std::size_t p = 0; p < n; ++p)
          {
            double &share = shares.back()[p];
            for (unsigned int i = 0; i < H.size(); ++i)
              {
                const VoigtMatrix<dim> part =
                  weight *
                  (is_linear ? (*now.fluidity[i])[p]
                             : (*now.creep)[p].fluidity(
                                 Field::get(*stress, p * Field::n_components)));
                H[i][p] += part;
                share += now.fractions[i] * part.norm();
              }
            K[p] += share * (*now.stiffness)[p];
            flow[p] += share;
          }
      }
    for (std::size_t p = 0; p < n; ++p)
      {
        if (flow[p] > 0.)
          K[p] /= flow[p];
        else // without stress power-law creep has no tangent
          K[p] = (*state.stiffness)[p];
        for (std::vector<double> &share : shares)
          share[p] = flow[p] > 0. ? share[p] / flow[p] : 1. / shares.size();
      }
    using Matrices = typename MaterialState<dim>::Matrices;
    if (body.material.stiffness_varies)
      state.stiffness = std::make_shared<const Matrices>(std::move(K));
    for (unsigned int i = 0; i < H.size(); ++i)
      state.fluidity[i] = std::make_shared<const Matrices>(std::move(H[i]));
    state.creep            = nullptr;
    state.stiffness_factor = state.viscosity_factor = 1.;
  }



  template <int dim>
  std::vector<dealii::Vector<double>>
  AveragedMaterial<dim>::weights_on_lip(
    const Body<dim>             &body,
    const DirectSolver::Indices &bounded) const
  {
    const unsigned int                              n = bounded.size();
    std::map<types::global_dof_index, unsigned int> numbers;
    for (unsigned int k = 0; k < n; ++k)
      numbers[bounded[k]] = k;
    // Sums over the cells around a bound, by stage, and numbers of points.
    std::vector<double>                  sums((shares.size() + 1) * n);
    std::vector<types::global_dof_index> unknowns;
    std::set<unsigned int>               around;
    for (const auto &cell : owned_cells(body.space.dof_handler))
      {
        around.clear();
        const auto include = [&](const types::global_dof_index unknown) {
          if (const auto found = numbers.find(unknown); found != numbers.end())
            around.insert(found->second);
        };
        body.space.get_unknowns(cell, unknowns);
        for (const types::global_dof_index unknown : unknowns)
          {
            include(unknown);
            if (const auto *const entries =
                  body.space.constraints.get_constraint_entries(unknown))
              for (const auto &entry : *entries)
                include(entry.first);
          }
        const std::size_t first = body.points.first_point(cell);
        const std::size_t end   = first + body.space.quadrature(cell).size();
        for (const unsigned int k : around)
          {
            for (unsigned int j = 0; j < shares.size(); ++j)
              sums[j * n + k] += std::accumulate(shares[j].begin() + first,
                                                 shares[j].begin() + end,
                                                 0.);
            sums[shares.size() * n + k] += end - first;
          }
      }
    Utilities::MPI::sum(sums, body.space.communicator(), sums);
    // A lip that is pressed while nothing flows must still be seen to be.
    constexpr double                    least = 1e-9;
    std::vector<dealii::Vector<double>> weights(shares.size(),
                                                dealii::Vector<double>(n));
    for (unsigned int j = 0; j < shares.size(); ++j)
      for (unsigned int k = 0; k < n; ++k)
        weights[j](k) =
          std::max(least, sums[j * n + k] / sums[shares.size() * n + k]);
    return weights;
  }



  template class AveragedMaterial<2>;
  template class AveragedMaterial<3>;
} // namespace Crevasse
