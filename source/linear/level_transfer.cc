// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/linear/level_transfer.h>

#include <deal.II/matrix_free/fe_evaluation.h>

#include <algorithm>
#include <cmath>

namespace Crevasse
{
  using namespace dealii;

  namespace
  {
    /** The degree is known when the program runs. */
    template <int dim>
    using CellValuesOf = FEEvaluation<dim, -1, 0, dim, double>;

    using Cells = std::vector<types::global_cell_index>;
  } // namespace



  template <int dim>
  LevelTransfer<dim>::LevelTransfer(const Space<dim>       &coarser,
                                    const Space<dim>       &finer,
                                    const CoarserMesh<dim> &mesh)
    : coarser(coarser)
    , finer(finer)
    , loops(coarser.matrix_free())
    , constrained(finer.matrix_free()->get_constrained_dofs())
  {
    make_rows();
    distribute_unknowns(mesh);
  }



  template <int dim>
  void
  LevelTransfer<dim>::make_rows()
  {
    const FESystem<dim>      &fe = coarser.finite_element();
    const unsigned int        n  = fe.n_dofs_per_cell();
    std::vector<unsigned int> place(n);
    const auto &numbering = loops->get_shape_info().lexicographic_numbering;
    for (unsigned int i = 0; i < n; ++i)
      place[numbering[i]] = i;

    for (unsigned int child = 0;
         child < GeometryInfo<dim>::max_children_per_cell;
         ++child)
      {
        const FullMatrix<double> &P = fe.get_prolongation_matrix(child);
        for (unsigned int i = 0; i < n; ++i)
          {
            for (unsigned int j = 0; j < n; ++j)
              if (std::abs(P(i, j)) > 1e-12)
                rows.entries.emplace_back(place[j], P(i, j));
            rows.starts.push_back(rows.entries.size());
          }
      }
    for (unsigned int i = 0; i < n; ++i)
      {
        rows.entries.emplace_back(place[i], 1.);
        rows.starts.push_back(rows.entries.size());
      }
  }



  template <int dim>
  std::vector<typename LevelTransfer<dim>::Dofs>
  LevelTransfer<dim>::unknowns_of(const Cells &cells) const
  {
    const unsigned int n     = finer.finite_element().n_dofs_per_cell();
    const IndexSet     owned = finer.mesh()
                             .global_active_cell_index_partitioner()
                             .lock()
                             ->locally_owned_range();
    std::vector<Dofs> of_own(owned.n_elements(), Dofs(n));
    for (const auto &cell : finer.dof_handler().active_cell_iterators())
      if (cell->is_locally_owned())
        cell->get_dof_indices(
          of_own[owned.index_within_set(cell->global_active_cell_index())]);

    Cells ascending(cells);
    std::sort(ascending.begin(), ascending.end());
    IndexSet needed(owned.size());
    needed.add_indices(ascending.begin(), ascending.end());
    Vector            of_cells(owned, needed, finer.communicator());
    std::vector<Dofs> found(cells.size(), Dofs(n));
    for (unsigned int i = 0; i < n; ++i)
      {
        for (std::size_t k = 0; k < of_own.size(); ++k)
          of_cells.local_element(k) = of_own[k][i];
        of_cells.update_ghost_values();
        for (std::size_t k = 0; k < cells.size(); ++k)
          found[k][i] = of_cells(cells[k]);
        of_cells.zero_out_ghost_values();
      }
    return found;
  }



  template <int dim>
  template <typename Function>
  void
  LevelTransfer<dim>::for_each_cell(const Function &f) const
  {
    for (unsigned int batch = 0; batch < loops->n_cell_batches(); ++batch)
      for (unsigned int lane = 0;
           lane < loops->n_active_entries_per_cell_batch(batch);
           ++lane)
        f(batch, lane, batch * Number::size() + lane);
  }



  template <int dim>
  void
  LevelTransfer<dim>::distribute_unknowns(const CoarserMesh<dim> &mesh)
  {
    const auto children_of = [&](const unsigned int batch,
                                 const unsigned int lane) -> const Cells & {
      return mesh
        .children[loops->get_cell_iterator(batch, lane)->active_cell_index()];
    };
    Cells all;
    for_each_cell([&](const unsigned int batch,
                      const unsigned int lane,
                      const std::size_t) {
      const Cells &children = children_of(batch, lane);
      all.insert(all.end(), children.begin(), children.end());
    });
    const std::vector<Dofs> dofs = unknowns_of(all);

    Dofs needed;
    for (const Dofs &of_cell : dofs)
      for (const auto dof : of_cell)
        if (!finer.locally_owned_unknowns().is_element(dof))
          needed.push_back(dof);
    std::sort(needed.begin(), needed.end());
    IndexSet ghosts(finer.n_unknowns());
    ghosts.add_indices(needed.begin(), needed.end());
    work.reinit(finer.locally_owned_unknowns(), ghosts, finer.communicator());
    const auto       &partitioner = *work.get_partitioner();
    std::vector<bool> is_done(partitioner.locally_owned_size() +
                              partitioner.n_ghost_indices());

    const unsigned int n        = finer.finite_element().n_dofs_per_cell();
    std::size_t        position = 0;
    starts.assign(loops->n_cell_batches() * Number::size() + 1, 0);
    for_each_cell([&](const unsigned int batch,
                      const unsigned int lane,
                      const std::size_t  index) {
      const std::size_t n_children = children_of(batch, lane).size();
      for (std::size_t c = 0; c < n_children; ++c, ++position)
        for (unsigned int i = 0; i < n; ++i)
          {
            const unsigned int unknown =
              partitioner.global_to_local(dofs[position][i]);
            if (is_done[unknown])
              continue;
            is_done[unknown] = true;
            unknowns.push_back(unknown);
            // After the rows of the children there are those of the cell.
            row_of_unknown.push_back(
              (n_children == 1 ? GeometryInfo<dim>::max_children_per_cell : c) *
                n +
              i);
          }
      starts[index + 1] = unknowns.size();
    });
    for (std::size_t k = 1; k < starts.size(); ++k) // empty lanes
      starts[k] = std::max(starts[k], starts[k - 1]);

    for (const unsigned int unknown : unknowns)
      work.local_element(unknown) = 1.;
    work.compress(VectorOperation::add);
    work.update_ghost_values();
    for (const unsigned int unknown : unknowns)
      if (work.local_element(unknown) > 1.5)
        shared.emplace_back(unknown, 1. / work.local_element(unknown));
    work.zero_out_ghost_values();
  }



  template <int dim>
  void
  LevelTransfer<dim>::prolongate_and_add(Vector       &of_finer,
                                         const Vector &of_coarser) const
  {
    of_coarser.update_ghost_values();
    work = 0.;
    CellValuesOf<dim> values(*loops);
    for_each_cell([&](const unsigned int batch,
                      const unsigned int lane,
                      const std::size_t  index) {
      if (lane == 0)
        {
          values.reinit(batch);
          values.read_dof_values(of_coarser);
        }
      for (std::size_t k = starts[index]; k < starts[index + 1]; ++k)
        {
          double             sum = 0.;
          const unsigned int row = row_of_unknown[k];
          for (auto e = rows.starts[row]; e < rows.starts[row + 1]; ++e)
            sum += rows.entries[e].second *
                   values.begin_dof_values()[rows.entries[e].first][lane];
          work.local_element(unknowns[k]) = sum;
        }
    });
    of_coarser.zero_out_ghost_values();
    for (const auto &[unknown, weight] : shared)
      work.local_element(unknown) *= weight;
    work.compress(VectorOperation::add);
    for (const unsigned int unknown : constrained)
      work.local_element(unknown) = 0.;
    for (std::size_t i = 0; i < of_finer.locally_owned_size(); ++i)
      of_finer.local_element(i) += work.local_element(i);
  }



  template <int dim>
  void
  LevelTransfer<dim>::restrict_and_add(Vector       &of_coarser,
                                       const Vector &of_finer) const
  {
    work.copy_locally_owned_data_from(of_finer);
    for (const unsigned int unknown : constrained)
      work.local_element(unknown) = 0.;
    work.update_ghost_values();
    for (const auto &[unknown, weight] : shared)
      work.local_element(unknown) *= weight;

    CellValuesOf<dim>  values(*loops);
    const unsigned int n = values.dofs_per_cell;
    for_each_cell([&](const unsigned int batch,
                      const unsigned int lane,
                      const std::size_t  index) {
      if (lane == 0)
        {
          values.reinit(batch);
          std::fill_n(values.begin_dof_values(), n, Number(0.));
        }
      for (std::size_t k = starts[index]; k < starts[index + 1]; ++k)
        {
          const double       value = work.local_element(unknowns[k]);
          const unsigned int row   = row_of_unknown[k];
          for (auto e = rows.starts[row]; e < rows.starts[row + 1]; ++e)
            values.begin_dof_values()[rows.entries[e].first][lane] +=
              rows.entries[e].second * value;
        }
      if (lane + 1 == loops->n_active_entries_per_cell_batch(batch))
        values.distribute_local_to_global(of_coarser);
    });
    of_coarser.compress(VectorOperation::add);
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

    const auto &numbering = loops->get_shape_info().lexicographic_numbering;
    Vector      found     = coarser.ghosted_vector();
    Dofs        dofs(coarser.finite_element().n_dofs_per_cell());
    for_each_cell([&](const unsigned int batch,
                      const unsigned int lane,
                      const std::size_t  index) {
      for (std::size_t k = starts[index]; k < starts[index + 1]; ++k)
        if (work.local_element(unknowns[k]) == 1.)
          {
            const unsigned int begin = rows.starts[row_of_unknown[k]];
            const unsigned int end   = rows.starts[row_of_unknown[k] + 1];
            if (end != begin + 1)
              continue; // between nodes of the coarser mesh
            loops->get_cell_iterator(batch, lane)->get_dof_indices(dofs);
            found(dofs[numbering[rows.entries[begin].first]]) += 1.;
          }
    });
    found.compress(VectorOperation::add);
    work.zero_out_ghost_values();

    std::vector<unsigned int> of_coarser;
    for (std::size_t i = 0; i < found.locally_owned_size(); ++i)
      if (found.local_element(i) > 0.)
        of_coarser.push_back(i);
    return of_coarser;
  }



  template <int dim>
  std::size_t
  LevelTransfer<dim>::memory_consumption() const
  {
    return starts.size() * sizeof(std::size_t) +
           unknowns.size() * (sizeof(unsigned int) + sizeof(std::uint16_t)) +
           shared.size() * sizeof(shared[0]) +
           constrained.size() * sizeof(unsigned int) +
           work.memory_consumption();
  }



  template class LevelTransfer<2>;
  template class LevelTransfer<3>;
} // namespace Crevasse
