// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/linear/stiffness_operator.h>

#include <algorithm>

namespace Crevasse
{
  using namespace dealii;

  template <int dim>
  StiffnessOperator<dim>::StiffnessOperator(
    const Space<dim>                    &space,
    const QuadratureField<dim>          &points,
    const PointValues<VoigtMatrix<dim>> &stiffness)
    : space(space)
    , product(space, points, stiffness)
  {
  }



  template <int dim>
  void
  StiffnessOperator<dim>::vmult(Vector &result, const Vector &v) const
  {
    const auto is_ours = [this](const Vector &vector) {
      return vector.get_partitioner() == diagonal().get_partitioner();
    };
    if (is_ours(v) && is_ours(result))
      {
        product.vmult(result, v);
        return;
      }
    copy_of_v.reinit(diagonal(), true);
    copy_of_result.reinit(diagonal(), true);
    copy_of_v.copy_locally_owned_data_from(v);
    product.vmult(copy_of_result, copy_of_v);
    result.copy_locally_owned_data_from(copy_of_result);
  }



  template <int dim>
  std::vector<LinearOperator::Indices>
  StiffnessOperator<dim>::couplings(const Indices &rows,
                                    const Indices &columns) const
  {
    // Couplings of all columns, which include the rows.
    std::map<types::global_dof_index, std::set<types::global_dof_index>> all;
    Indices of_cell, found;
    for (const auto &cell : space.dof_handler.active_cell_iterators())
      {
        if (cell->is_artificial())
          continue;
        space.get_unknowns(cell, of_cell);
        found.clear();
        const auto note = [&](const types::global_dof_index dof) {
          if (std::binary_search(columns.begin(), columns.end(), dof))
            found.push_back(dof);
        };
        for (const auto dof : of_cell)
          if (const auto *masters =
                space.constraints.get_constraint_entries(dof))
            for (const auto &master : *masters)
              note(master.first);
          else
            note(dof);
        for (const auto dof : found)
          all[dof].insert(found.begin(), found.end());
      }

    std::vector<Indices> coupled(rows.size());
    for (std::size_t k = 0; k < rows.size(); ++k)
      for (const auto dof : all[rows[k]])
        if (dof != rows[k])
          coupled[k].push_back(dof);
    return coupled;
  }



  template <int dim>
  std::size_t
  StiffnessOperator<dim>::memory_consumption() const
  {
    return product.memory_consumption() + copy_of_v.memory_consumption() +
           copy_of_result.memory_consumption();
  }



  template class StiffnessOperator<2>;
  template class StiffnessOperator<3>;
} // namespace Crevasse
