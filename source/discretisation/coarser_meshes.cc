// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/discretisation/coarser_meshes.h>

#include <deal.II/distributed/cell_data_transfer.templates.h>

namespace Crevasse
{
  using namespace dealii;

  namespace
  {
    using Cells = std::vector<types::global_cell_index>;

    /** Coarsens all cells that can be coarsened; returns the children of the
     * resulting cells. */
    template <int dim>
    std::vector<Cells>
    coarsen(Mesh<dim> &mesh)
    {
      std::vector<Cells> numbers(mesh.n_active_cells());
      for (const auto &cell : owned_cells(mesh))
        numbers[cell->active_cell_index()] = {cell->global_active_cell_index()};

      const auto all_of_them = [](const auto &, const std::vector<Cells> &of) {
        Cells all;
        for (const Cells &cells : of)
          all.insert(all.end(), cells.begin(), cells.end());
        return all;
      };
      for (const auto &cell : mesh.active_cell_iterators())
        if (cell->is_locally_owned() && cell->level() > 0)
          cell->set_coarsen_flag();
      mesh.prepare_coarsening_and_refinement();
      parallel::distributed::CellDataTransfer<dim, dim, std::vector<Cells>>
        transfer(mesh,
                 true,
                 &AdaptationStrategies::Refinement::preserve<dim, dim, Cells>,
                 all_of_them);
      transfer.prepare_for_coarsening_and_refinement(numbers);
      mesh.execute_coarsening_and_refinement();
      std::vector<Cells> children(mesh.n_active_cells());
      transfer.unpack(children);
      return children;
    }
  } // namespace



  template <int dim>
  std::vector<CoarserMesh<dim>>
  coarser_meshes(const Mesh<dim> &mesh, const std::size_t enough)
  {
    Mesh<dim> current(mesh.get_communicator(), mesh.get_mesh_smoothing());
    current.copy_triangulation(mesh);

    std::vector<CoarserMesh<dim>> meshes;
    while (current.n_global_active_cells() > enough &&
           current.n_global_levels() > 1)
      {
        const auto n_before = current.n_global_active_cells();
        auto       children = coarsen(current);
        if (current.n_global_active_cells() == n_before)
          break;
        auto copy = std::make_shared<Mesh<dim>>(mesh.get_communicator(),
                                                mesh.get_mesh_smoothing());
        copy->copy_triangulation(current);
        meshes.push_back({std::move(copy), std::move(children)});
      }
    return meshes;
  }



  template <int dim>
  std::vector<VoigtMatrix<dim>>
  means_over_children(const Mesh<dim>                     &finer,
                      const CoarserMesh<dim>              &coarser,
                      const std::vector<VoigtMatrix<dim>> &of_finer)
  {
    const IndexSet &owned = finer.global_active_cell_index_partitioner()
                              .lock()
                              ->locally_owned_range();
    Cells needed;
    for (const Cells &cells : coarser.children)
      needed.insert(needed.end(), cells.begin(), cells.end());
    std::sort(needed.begin(), needed.end());
    IndexSet ghosts(owned.size());
    ghosts.add_indices(needed.begin(), needed.end());
    Vector entries(owned, ghosts, finer.get_communicator());

    std::vector<VoigtMatrix<dim>> means(coarser.mesh->n_active_cells());
    for (unsigned int i = 0; i < n_stress_components<dim>; ++i)
      for (unsigned int j = 0; j < n_stress_components<dim>; ++j)
        {
          entries.zero_out_ghost_values();
          for (const auto &cell : owned_cells(finer))
            entries(cell->global_active_cell_index()) =
              of_finer[cell->active_cell_index()][i][j];
          entries.update_ghost_values();
          for (std::size_t c = 0; c < means.size(); ++c)
            for (const auto child : coarser.children[c])
              means[c][i][j] += entries(child) / coarser.children[c].size();
        }
    return means;
  }



  template decltype(coarser_meshes<2>)      coarser_meshes<2>;
  template decltype(coarser_meshes<3>)      coarser_meshes<3>;
  template decltype(means_over_children<2>) means_over_children<2>;
  template decltype(means_over_children<3>) means_over_children<3>;
} // namespace Crevasse
