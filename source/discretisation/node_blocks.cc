// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/discretisation/node_blocks.h>



namespace Crevasse
{
  using namespace dealii;

  template <int dim>
  std::vector<std::vector<types::global_dof_index>>
  node_blocks(const Space<dim> &space)
  {
    const FESystem<dim> &fe = space.finite_element();

    // The dof of component 0 stands for the node. All of a node are of one
    // rank.
    const IndexSet &own = space.dof_handler().locally_owned_dofs();
    std::vector<std::vector<types::global_dof_index>> of_first_dof(
      own.n_elements());
    std::vector<types::global_dof_index> indices(fe.n_dofs_per_cell());
    for (const auto &cell : space.dof_handler().active_cell_iterators())
      {
        if (!cell->is_locally_owned())
          continue;
        cell->get_dof_indices(indices);
        for (unsigned int i = 0; i < fe.n_dofs_per_cell(); ++i)
          if (fe.system_to_component_index(i).first == 0 &&
              own.is_element(indices[i]))
            {
              const unsigned int shape = fe.system_to_component_index(i).second;
              auto &block = of_first_dof[own.index_within_set(indices[i])];
              block.clear();
              for (unsigned int c = 0; c < dim; ++c)
                block.push_back(
                  indices[fe.component_to_system_index(c, shape)]);
            }
      }

    std::vector<std::vector<types::global_dof_index>> blocks;
    for (auto &block : of_first_dof)
      if (!block.empty())
        blocks.push_back(std::move(block));
    for (auto i = space.dof_handler().n_dofs(); i < space.n_unknowns(); ++i)
      if (space.locally_owned_unknowns().is_element(i))
        blocks.push_back({i});
    return blocks;
  }



  template std::vector<std::vector<types::global_dof_index>>
  node_blocks<2>(const Space<2> &);
  template std::vector<std::vector<types::global_dof_index>>
  node_blocks<3>(const Space<3> &);
} // namespace Crevasse
