// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_linear_level_transfer_h
#define crevasse_linear_level_transfer_h

#include <crevasse/discretisation/coarser_meshes.h>
#include <crevasse/discretisation/space.h>

#include <deal.II/matrix_free/matrix_free.h>

#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

namespace Crevasse
{
  /**
   * Interpolation from the displacements of a coarser mesh to those of a finer
   * one, and its transpose, cell by cell. (That of deal.II 9.4,
   * MGTwoLevelTransfer, needs memory for as many cells as a mesh would have
   * that is everywhere as fine as at a crack tip.)
   */
  template <int dim>
  class LevelTransfer
  {
  public:
    /** @param mesh the mesh of the coarser space, made from that of the finer.
     * Both spaces must outlive this object. Collective. */
    LevelTransfer(const Space<dim>       &coarser,
                  const Space<dim>       &finer,
                  const CoarserMesh<dim> &mesh);

    /** of_finer += P of_coarser. Constrained entries stay what they are. Both
     * with the layout of MatrixFree. */
    void
    prolongate_and_add(Vector &of_finer, const Vector &of_coarser) const;

    /** of_coarser += Pᵀ of_finer */
    void
    restrict_and_add(Vector &of_coarser, const Vector &of_finer) const;

    /** The unknowns of the coarser space at the same nodes as these of the
     * finer one; locally owned ones, as ascending local indices. Collective. */
    std::vector<unsigned int>
    at_same_nodes(const std::vector<unsigned int> &of_finer) const;

    std::size_t
    memory_consumption() const;

  private:
    using Number = dealii::VectorizedArray<double>;
    using Dofs   = std::vector<dealii::types::global_dof_index>;

    /** The interpolation to all unknowns of all children of a cell, child by
     * child, and then to those of the cell itself: in each row the unknowns of
     * the coarser cell, by their place in FEEvaluation, with their weights. */
    struct Rows
    {
      std::vector<unsigned int>                    starts = {0};
      std::vector<std::pair<unsigned int, double>> entries;
    };

    void
    make_rows();

    /** The unknowns of finer cells, in the order that is asked for. */
    std::vector<Dofs>
    unknowns_of(
      const std::vector<dealii::types::global_cell_index> &cells) const;

    /** Finds out which unknowns this rank interpolates from each cell. */
    void
    distribute_unknowns(const CoarserMesh<dim> &mesh);

    /** f(batch, lane, index) for the cells of the coarser mesh. */
    template <typename Function>
    void
    for_each_cell(const Function &f) const;

    const Space<dim>                                            &coarser;
    const Space<dim>                                            &finer;
    const std::shared_ptr<const dealii::MatrixFree<dim, double>> loops;
    const std::vector<unsigned int> constrained; ///< of the finer space
    Rows                            rows;

    // What is interpolated from each lane of each batch of cells of the coarser
    // mesh: unknowns of the finer one, as local indices of the work vector,
    // each but once, and how.
    std::vector<std::size_t>   starts;
    std::vector<unsigned int>  unknowns;
    std::vector<std::uint16_t> row_of_unknown;

    /** Unknowns that several ranks interpolate, with the weight of each. */
    std::vector<std::pair<unsigned int, double>> shared;

    mutable Vector work; ///< of the finer space, with what is interpolated here
  };
} // namespace Crevasse

#endif
