// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/linear/multigrid_levels.h>

#include <algorithm>

namespace Crevasse
{
  using namespace dealii;

  namespace
  {
    /** Number of unknowns up to which a direct solver beats a smoother. */
    constexpr std::size_t enough_unknowns = 1500;
  } // namespace



  template <int dim>
  MultigridLevels<dim>::MultigridLevels(const Space<dim>           &space,
                                        const QuadratureField<dim> &points)
    : finest(space)
    , finest_points(points)
    , meshes(coarser_meshes(space.mesh(),
                            enough_unknowns /
                              (dim * Utilities::pow(space.finite_element.degree,
                                                    dim))))
  {
    for (const CoarserMesh<dim> &coarser : meshes)
      if (auto on_coarser = space.on_coarser(coarser.mesh))
        spaces.push_back(std::move(on_coarser));
      else
        break; // A coarser matrix would be singular.
    meshes.resize(spaces.size());
    std::reverse(meshes.begin(), meshes.end());
    std::reverse(spaces.begin(), spaces.end());
    for (const auto &on_coarser : spaces)
      coarse_points.push_back(
        std::make_unique<const QuadratureField<dim>>(*on_coarser));
    for (unsigned int level = 1; level < n_levels(); ++level)
      transfers.push_back(std::make_unique<const LevelTransfer<dim>>(
        this->space(level - 1), this->space(level), meshes[level - 1]));
  }



  template <int dim>
  std::vector<PointValues<VoigtMatrix<dim>>>
  MultigridLevels<dim>::on_coarser_levels(
    const PointValues<VoigtMatrix<dim>> &stiffness) const
  {
    if (stiffness.is_uniform())
      return std::vector<PointValues<VoigtMatrix<dim>>>(n_levels() - 1,
                                                        stiffness);

    std::vector<PointValues<VoigtMatrix<dim>>> values;
    std::vector<VoigtMatrix<dim>>              means =
      cell_means(finest, finest_points, stiffness);
    for (unsigned int level = n_levels() - 1; level-- > 0;)
      {
        means =
          means_over_children(space(level + 1).mesh(), meshes[level], means);
        std::vector<std::uint32_t> which(points(level).n_local_points);
        for (const auto &cell : space(level).mesh().active_cell_iterators())
          if (cell->is_locally_owned())
            {
              const auto begin = which.begin() + points(level).offset(cell) /
                                                   n_stress_components<dim>;
              std::fill(begin,
                        begin + space(level).quadrature(cell).size(),
                        cell->active_cell_index());
            }
        auto of_level = means;
        values.emplace_back(std::move(of_level), std::move(which));
      }
    std::reverse(values.begin(), values.end());
    return values;
  }



  template <int dim>
  std::size_t
  MultigridLevels<dim>::memory_consumption() const
  {
    std::size_t bytes = 0;
    for (const auto &space : spaces)
      bytes += space->mesh().memory_consumption() +
               space->dof_handler.memory_consumption() +
               space->constraints.memory_consumption() +
               space->cell_loops()->memory_consumption();
    for (const auto &transfer : transfers)
      bytes += transfer->memory_consumption();
    return bytes;
  }



  template class MultigridLevels<2>;
  template class MultigridLevels<3>;
} // namespace Crevasse
