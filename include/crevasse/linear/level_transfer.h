// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_linear_level_transfer_h
#define crevasse_linear_level_transfer_h

#include <crevasse/discretisation/cell_loops.h>
#include <crevasse/discretisation/coarser_meshes.h>

namespace Crevasse
{
  /** Preconditioners need no more than single precision. */
  using LevelReal   = float;
  using LevelVector = dealii::LinearAlgebra::distributed::Vector<LevelReal>;

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
    using Vector = LevelVector;

    /** @param mesh the mesh of the coarser space, made from that of the finer.
     * Both spaces must outlive this object. Collective. */
    LevelTransfer(const Space<dim>       &coarser,
                  const Space<dim>       &finer,
                  const CoarserMesh<dim> &mesh);

    /** of_finer += P of_coarser. Constrained entries stay what they are. Both
     * with the layout of CellLoops. */
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
    using Dofs = std::vector<dealii::types::global_dof_index>;

    /** The interpolation to all nodes of all children of a cell, child by
     * child, and then to those of the cell itself: in each row the nodes of the
     * coarser cell with their weights, the same for all components. */
    struct Rows
    {
      std::vector<unsigned int>                       starts = {0};
      std::vector<std::pair<unsigned int, LevelReal>> entries;
    };

    void
    make_rows();

    /** The first unknowns of all nodes of finer cells, in the order that is
     * asked for. */
    Dofs
    nodes_of(const std::vector<dealii::types::global_cell_index> &cells) const;

    /** Finds out which nodes this rank interpolates from each cell. */
    void
    distribute_nodes(const CoarserMesh<dim> &mesh);

    void
    weight_shared_nodes() const;

    const Space<dim>                           &coarser;
    const Space<dim>                           &finer;
    const std::shared_ptr<const CellLoops<dim>> loops; ///< of the coarser
    const std::shared_ptr<const CellLoops<dim>> finer_loops;
    std::vector<unsigned int> first_dofs; ///< of the element, for each node
    Rows                      rows;

    // What is interpolated from each cell of the coarser mesh: nodes of the
    // finer one, each but once, as local indices of their first components in
    // the work vector, and how.
    std::vector<std::size_t>   starts = {0};
    std::vector<unsigned int>  first_indices;
    std::vector<std::uint16_t> row_of_node;

    /** Nodes that several ranks interpolate, with the weight of each. */
    std::vector<std::pair<unsigned int, LevelReal>> shared;

    /** What this rank's degrees of freedom contribute to an unknown of the
     * finer lips, as local indices. */
    struct LipEntry
    {
      unsigned int unknown, dof;
      LevelReal    weight;
    };
    std::vector<LipEntry> lip_entries;

    mutable Vector work; ///< of the finer space, with what is interpolated here
  };
} // namespace Crevasse

#endif
