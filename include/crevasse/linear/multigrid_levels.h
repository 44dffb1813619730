// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_linear_multigrid_levels_h
#define crevasse_linear_multigrid_levels_h

#include <crevasse/linear/level_transfer.h>

namespace Crevasse
{
  /**
   * Levels of geometric multigrid, which do not depend on the material: coarser
   * meshes of the whole body (global coarsening: Becker and Braack 2000; Munch
   * et al., ACM Trans. Parallel Comput. 10, 2023), their displacement spaces,
   * and the transfer between them. Level 0 is the coarsest.
   */
  template <int dim>
  class MultigridLevels
  {
  public:
    /** Makes the levels. Both arguments must outlive them. Collective. */
    MultigridLevels(const Space<dim>           &space,
                    const QuadratureField<dim> &points);

    unsigned int
    n_levels() const
    {
      return meshes.size() + 1;
    }

    const Space<dim> &
    space(const unsigned int level) const
    {
      return level < spaces.size() ? *spaces[level] : finest;
    }

    const QuadratureField<dim> &
    points(const unsigned int level) const
    {
      return level < spaces.size() ? *coarse_points[level] : finest_points;
    }

    /** Transfer between a level, at least 1, and the next coarser level. */
    const LevelTransfer<dim> &
    transfer(const unsigned int level) const
    {
      return *transfers[level - 1];
    }

    /** Means of a stiffness over the cells of all levels but the finest.
     * Collective. */
    std::vector<PointValues<VoigtMatrix<dim>>>
    on_coarser_levels(const PointValues<VoigtMatrix<dim>> &stiffness) const;

    /** Bytes of the levels on this rank, without the finest mesh and space. */
    std::size_t
    memory_consumption() const;

  private:
    const Space<dim>                                        &finest;
    const QuadratureField<dim>                              &finest_points;
    std::vector<CoarserMesh<dim>>                            meshes;
    std::vector<std::shared_ptr<const Space<dim>>>           spaces;
    std::vector<std::unique_ptr<const QuadratureField<dim>>> coarse_points;
    std::vector<std::unique_ptr<const LevelTransfer<dim>>>   transfers;
  };
} // namespace Crevasse

#endif
