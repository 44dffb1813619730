// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_linear_level_transfer_h
#define crevasse_linear_level_transfer_h

#include <crevasse/discretisation/cell_loops.h>
#include <crevasse/discretisation/coarser_meshes.h>

namespace Crevasse
{
  /** Multigrid levels use single precision: enough for a preconditioner. */
  using LevelReal   = float;
  using LevelVector = dealii::LinearAlgebra::distributed::Vector<LevelReal>;

  /**
   * Interpolation from the displacements of a coarser mesh to those of a finer
   * one, and its transpose, cell by cell. (MGTwoLevelTransfer of deal.II 9.4
   * needs memory for as many cells as a mesh that is everywhere as fine as at a
   * crack tip.)
   */
  template <int dim>
  class LevelTransfer
  {
  public:
    using Vector = LevelVector;

    /** @param mesh Mesh of the coarser space, made from that of the finer
     * space. Both spaces must outlive this object. Collective. */
    LevelTransfer(const Space<dim>       &coarser,
                  const Space<dim>       &finer,
                  const CoarserMesh<dim> &mesh);

    /** Prolongates: of_finer += P of_coarser. Constrained entries stay. Both
     * vectors have the layout of CellLoops. */
    void
    prolongate_and_add(Vector &of_finer, const Vector &of_coarser) const;

    /** Restricts: of_coarser += Pᵀ of_finer. */
    void
    restrict_and_add(Vector &of_coarser, const Vector &of_finer) const;

    /** Locally owned unknowns of the coarser space at the nodes of these
     * unknowns of the finer space, as ascending local indices. Collective. */
    std::vector<unsigned int>
    at_same_nodes(const std::vector<unsigned int> &of_finer) const;

    std::size_t
    memory_consumption() const;

  private:
    using Dofs = std::vector<dealii::types::global_dof_index>;

    /** Interpolation to all nodes of all children of a cell, child by child,
     * and then to those of the cell itself: each row has nodes of the coarser
     * cell with their weights, the same for all components. */
    struct Rows
    {
      std::vector<unsigned int>                       starts = {0};
      std::vector<std::pair<unsigned int, LevelReal>> entries;
    };

    void
    make_rows();

    /** First unknowns of all nodes of the given finer cells, in their order. */
    Dofs
    nodes_of(const std::vector<dealii::types::global_cell_index> &cells) const;

    /** Determines the nodes that this rank interpolates from each cell. */
    void
    distribute_nodes(const CoarserMesh<dim> &mesh);

    void
    weight_shared_nodes() const;

    const Space<dim>                           &coarser;
    const Space<dim>                           &finer;
    const std::shared_ptr<const CellLoops<dim>> loops; ///< coarser loops
    const std::shared_ptr<const CellLoops<dim>> finer_loops;
    std::vector<unsigned int> first_dofs; ///< first dof of each element node
    Rows                      rows;

    // Nodes of the finer mesh interpolated from each cell of the coarser mesh,
    // each node once: local indices of their first components in the work
    // vector, and their rows.
    std::vector<std::size_t>   starts = {0};
    std::vector<unsigned int>  first_indices;
    std::vector<std::uint16_t> row_of_node;

    /** Nodes that several ranks interpolate, with the weight of this rank. */
    std::vector<std::pair<unsigned int, LevelReal>> shared;

    /** Contribution of a degree of freedom of this rank to an unknown of the
     * finer lips, as local indices. */
    struct LipEntry
    {
      unsigned int unknown, dof;
      LevelReal    weight;
    };
    std::vector<LipEntry> lip_entries;

    mutable Vector work; ///< interpolated values of the finer space
  };
} // namespace Crevasse

#endif
