// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/linear/level_transfer.h>

#include <algorithm>

namespace Crevasse
{
  using namespace dealii;

  namespace
  {
    using Cells = std::vector<types::global_cell_index>;



    /** Calls f(unknown, dof) for openings that are not degrees of freedom, with
     * a dof of one of their nodes. */
    template <int dim, typename Function>
    void
    for_each_opening(const Space<dim> &space, const Function &f)
    {
      for (const auto &node : space.lip.nodes)
        if (node.has_unknown() && node.unknown >= space.dof_handler.n_dofs())
          f(node.unknown, node.sides[0] + node.component());
    }
  } // namespace



  template <int dim>
  LevelTransfer<dim>::LevelTransfer(const Space<dim>       &coarser,
                                    const Space<dim>       &finer,
                                    const CoarserMesh<dim> &mesh)
    : coarser(coarser)
    , finer(finer)
    , loops(coarser.cell_loops())
    , finer_loops(finer.cell_loops())
  {
    make_rows();
    distribute_nodes(mesh);
    const auto &partitioner = *work.get_partitioner();
    for (const auto &[unknown, weights] : finer.lip.functionals)
      for (const auto &[dof, weight] : weights)
        if (finer.locally_owned_unknowns.is_element(dof))
          lip_entries.push_back({partitioner.global_to_local(unknown),
                                 partitioner.global_to_local(dof),
                                 LevelReal(weight)});
  }



  template <int dim>
  void
  LevelTransfer<dim>::make_rows()
  {
    const FESystem<dim> &fe    = coarser.finite_element;
    const auto          &place = loops->places();
    first_dofs.resize(loops->n_nodes_per_cell());
    for (unsigned int i = 0; i < fe.n_dofs_per_cell(); ++i)
      if (place[i] % dim == 0)
        first_dofs[place[i] / dim] = i;

    for (unsigned int child = 0;
         child < GeometryInfo<dim>::max_children_per_cell;
         ++child)
      {
        const FullMatrix<double> &P = fe.get_prolongation_matrix(child);
        for (const unsigned int i : first_dofs)
          {
            for (unsigned int node = 0; node < first_dofs.size(); ++node)
              if (const double weight = P(i, first_dofs[node]);
                  std::abs(weight) > 1e-12)
                rows.entries.emplace_back(node, weight);
            rows.starts.push_back(rows.entries.size());
          }
      }
    for (unsigned int node = 0; node < first_dofs.size(); ++node)
      {
        rows.entries.emplace_back(node, 1.);
        rows.starts.push_back(rows.entries.size());
      }
  }



  template <int dim>
  std::vector<types::global_dof_index>
  LevelTransfer<dim>::nodes_of(const Cells &cells) const
  {
    const IndexSet owned = finer.mesh()
                             .global_active_cell_index_partitioner()
                             .lock()
                             ->locally_owned_range();
    const unsigned int n_nodes = first_dofs.size();
    Dofs               of_own(owned.n_elements() * n_nodes);
    Dofs               dofs(finer.finite_element.n_dofs_per_cell());
    for (const auto &cell : owned_cells(finer.dof_handler))
      {
        cell->get_dof_indices(dofs);
        const std::size_t k =
          owned.index_within_set(cell->global_active_cell_index());
        for (unsigned int node = 0; node < n_nodes; ++node)
          of_own[k * n_nodes + node] = dofs[first_dofs[node]];
      }

    Cells ascending(cells);
    std::sort(ascending.begin(), ascending.end());
    IndexSet needed(owned.size());
    needed.add_indices(ascending.begin(), ascending.end());
    Crevasse::Vector of_cells(owned, needed, finer.communicator());
    Dofs             found(cells.size() * n_nodes);
    for (unsigned int node = 0; node < n_nodes; ++node)
      {
        for (std::size_t k = 0; k < of_cells.locally_owned_size(); ++k)
          of_cells.local_element(k) = of_own[k * n_nodes + node];
        of_cells.update_ghost_values();
        for (std::size_t k = 0; k < cells.size(); ++k)
          found[k * n_nodes + node] = of_cells(cells[k]);
        of_cells.zero_out_ghost_values();
      }
    return found;
  }



  template <int dim>
  void
  LevelTransfer<dim>::distribute_nodes(const CoarserMesh<dim> &mesh)
  {
    std::vector<std::size_t> n_children; // for each cell of the loops
    Cells                    all;
    loops->for_each_cell([&](const auto &cell, const unsigned int) {
      const Cells &children = mesh.children[cell->active_cell_index()];
      n_children.push_back(children.size());
      all.insert(all.end(), children.begin(), children.end());
    });
    const Dofs dofs = nodes_of(all);

    Dofs needed;
    for (const auto dof : dofs)
      if (!finer.locally_owned_unknowns.is_element(dof))
        for (unsigned int c = 0; c < dim; ++c)
          needed.push_back(dof + c);
    for (const auto &[unknown, weights] : finer.lip.functionals)
      if (!finer.locally_owned_unknowns.is_element(unknown))
        needed.push_back(unknown);
    std::sort(needed.begin(), needed.end());
    IndexSet ghosts(finer.n_unknowns());
    ghosts.add_indices(needed.begin(), needed.end());
    work.reinit(finer.locally_owned_unknowns, ghosts, finer.communicator());
    const auto       &partitioner = *work.get_partitioner();
    std::vector<bool> is_done(partitioner.locally_owned_size() +
                              partitioner.n_ghost_indices());

    const unsigned int n_nodes = first_dofs.size();
    auto               dof     = dofs.begin();
    for (const std::size_t n : n_children)
      {
        for (std::size_t child = 0; child < n; ++child)
          for (unsigned int node = 0; node < n_nodes; ++node, ++dof)
            {
              const unsigned int index = partitioner.global_to_local(*dof);
              if (is_done[index])
                continue;
              is_done[index] = true;
              first_indices.push_back(index);
              // The rows of the cell itself follow the rows of its children.
              row_of_node.push_back(
                (n == 1 ? GeometryInfo<dim>::max_children_per_cell : child) *
                  n_nodes +
                node);
            }
        starts.push_back(first_indices.size());
      }

    for (const unsigned int index : first_indices)
      work.local_element(index) = 1.;
    work.compress(VectorOperation::add);
    work.update_ghost_values();
    for (const unsigned int index : first_indices)
      if (work.local_element(index) > 1.5)
        shared.emplace_back(index, 1. / work.local_element(index));
    work.zero_out_ghost_values();
  }



  template <int dim>
  void
  LevelTransfer<dim>::weight_shared_nodes() const
  {
    for (const auto &[index, weight] : shared)
      for (unsigned int c = 0; c < dim; ++c)
        work.local_element(index + c) *= weight;
  }



  template <int dim>
  void
  LevelTransfer<dim>::prolongate_and_add(Vector       &of_finer,
                                         const Vector &of_coarser) const
  {
    using Value = std::array<LevelReal, dim>;
    work        = 0.;
    {
      const typename CellLoops<dim>::template ResolvedValues<LevelReal>
                             resolved(*loops, of_coarser);
      const LevelReal *const from = of_coarser.begin();
      LevelReal *const       to   = work.begin();
      std::vector<Value>     values(loops->n_nodes_per_cell());
      for (unsigned int cell = 0; cell < loops->n_cells(); ++cell)
        {
          const unsigned int *const first = loops->first_indices(cell);
          for (unsigned int node = 0; node < values.size(); ++node)
            for (unsigned int c = 0; c < dim; ++c)
              values[node][c] = from[first[node] + c];
          for (std::size_t k = starts[cell]; k < starts[cell + 1]; ++k)
            {
              Value              sum{};
              const unsigned int row = row_of_node[k];
              for (auto e = rows.starts[row]; e < rows.starts[row + 1]; ++e)
                for (unsigned int c = 0; c < dim; ++c)
                  sum[c] +=
                    rows.entries[e].second * values[rows.entries[e].first][c];
              for (unsigned int c = 0; c < dim; ++c)
                to[first_indices[k] + c] = sum[c];
            }
        }
    }
    weight_shared_nodes();
    work.compress(VectorOperation::add);
    if (!finer.lip.functionals.empty())
      {
        for (const auto &[unknown, dof, weight] : lip_entries)
          work.local_element(unknown) += weight * work.local_element(dof);
        work.compress(VectorOperation::add);
      }
    for (const unsigned int unknown : finer_loops->constrained())
      work.local_element(unknown) = 0.;
    for (std::size_t i = 0; i < of_finer.locally_owned_size(); ++i)
      of_finer.local_element(i) += work.local_element(i);
  }



  template <int dim>
  void
  LevelTransfer<dim>::restrict_and_add(Vector       &of_coarser,
                                       const Vector &of_finer) const
  {
    using Value = std::array<LevelReal, dim>;
    work.copy_locally_owned_data_from(of_finer);
    for (const unsigned int unknown : finer_loops->constrained())
      work.local_element(unknown) = 0.;
    work.update_ghost_values();
    if (!finer.lip.functionals.empty())
      {
        for (const auto &[unknown, dof, weight] : lip_entries)
          work.local_element(dof) += weight * work.local_element(unknown);
        work.update_ghost_values();
      }
    weight_shared_nodes();

    of_coarser.zero_out_ghost_values();
    const LevelReal *const from = work.begin();
    LevelReal *const       to   = of_coarser.begin();
    std::vector<Value>     values(loops->n_nodes_per_cell());
    for (unsigned int cell = 0; cell < loops->n_cells(); ++cell)
      {
        std::fill(values.begin(), values.end(), Value{});
        for (std::size_t k = starts[cell]; k < starts[cell + 1]; ++k)
          {
            const LevelReal *const value = from + first_indices[k];
            const unsigned int     row   = row_of_node[k];
            for (auto e = rows.starts[row]; e < rows.starts[row + 1]; ++e)
              for (unsigned int c = 0; c < dim; ++c)
                values[rows.entries[e].first][c] +=
                  rows.entries[e].second * value[c];
          }
        const unsigned int *const first = loops->first_indices(cell);
        for (unsigned int node = 0; node < values.size(); ++node)
          for (unsigned int c = 0; c < dim; ++c)
            to[first[node] + c] += values[node][c];
      }
    loops->distribute(of_coarser);
    work.zero_out_ghost_values();
  }



  template <int dim>
  std::vector<unsigned int>
  LevelTransfer<dim>::at_same_nodes(
    const std::vector<unsigned int> &of_finer) const
  {
    work = 0.;
    for (const unsigned int unknown : of_finer)
      work.local_element(unknown) = 1.;
    work.update_ghost_values();
    // Openings that are not degrees of freedom are located at their nodes.
    for_each_opening(finer, [this](const auto unknown, const auto dof) {
      if (finer.locally_owned_unknowns.is_element(dof))
        work(dof) = work(unknown);
    });
    work.update_ghost_values();

    Vector found;
    loops->initialize(found);
    for (unsigned int cell = 0; cell < loops->n_cells(); ++cell)
      for (std::size_t k = starts[cell]; k < starts[cell + 1]; ++k)
        {
          const unsigned int row = row_of_node[k];
          if (rows.starts[row + 1] != rows.starts[row] + 1)
            continue; // not at a node of the coarser mesh
          const unsigned int first =
            loops->first_indices(cell)[rows.entries[rows.starts[row]].first];
          for (unsigned int c = 0; c < dim; ++c)
            found.local_element(first + c) +=
              work.local_element(first_indices[k] + c);
        }
    found.compress(VectorOperation::add);
    work.zero_out_ghost_values();
    Vector openings(coarser.locally_owned_unknowns,
                    coarser.locally_relevant_unknowns,
                    coarser.communicator());
    for_each_opening(coarser, [&](const auto unknown, const auto dof) {
      if (coarser.locally_owned_unknowns.is_element(dof))
        {
          openings(unknown) += found(dof);
          found(dof) = 0.;
        }
    });
    openings.compress(VectorOperation::add);

    std::vector<unsigned int> of_coarser;
    for (std::size_t i = 0; i < found.locally_owned_size(); ++i)
      if (found.local_element(i) + openings.local_element(i) > 0.)
        of_coarser.push_back(i);
    return of_coarser;
  }



  template <int dim>
  std::size_t
  LevelTransfer<dim>::memory_consumption() const
  {
    return starts.size() * sizeof(std::size_t) +
           first_indices.size() *
             (sizeof(unsigned int) + sizeof(std::uint16_t)) +
           shared.size() * sizeof(shared[0]) +
           lip_entries.size() * sizeof(LipEntry) + work.memory_consumption();
  }



  template class LevelTransfer<2>;
  template class LevelTransfer<3>;
} // namespace Crevasse
