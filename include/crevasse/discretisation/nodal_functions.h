// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_discretisation_nodal_functions_h
#define crevasse_discretisation_nodal_functions_h

#include <crevasse/discretisation/space.h>

#include <map>

namespace Crevasse
{
  /** Nodes of a boundary: points by the degrees of freedom of a component, in
   * the cells that this rank sees. */
  template <int dim>
  std::map<dealii::types::global_dof_index, dealii::Point<dim>>
  nodes_on(const Space<dim>                &space,
           const dealii::types::boundary_id id,
           const unsigned int               component);

  /** Sums of the shape functions of degrees of freedom with the same number;
   * hanging nodes are interpolated. */
  template <int dim>
  class NodalFunctions
  {
  public:
    using Numbers = std::map<dealii::types::global_dof_index, unsigned int>;
    /** Numbers of functions, and their values. */
    using Parts = std::vector<std::pair<unsigned int, double>>;

    NodalFunctions(const Space<dim> &space, const Numbers &numbers);

    /** Values of the functions at the node of a degree of freedom in the cells
     * of this rank. */
    Parts
    parts_of(const dealii::types::global_dof_index dof) const;

    /** Value of a function at the node of degree of freedom i of a cell. */
    struct Part
    {
      unsigned int i;
      unsigned int number;
      double       value;
    };

    /** Calls f(cell, parts) for this rank's cells in which a function is not
     * 0. */
    template <typename Function>
    void
    for_each_cell(const Function &f) const
    {
      std::vector<dealii::types::global_dof_index> dofs(
        space.finite_element.n_dofs_per_cell());
      for (const auto &cell : owned_cells(space.dof_handler))
        {
          cell->get_dof_indices(dofs);
          std::vector<Part> parts;
          for (unsigned int i = 0; i < dofs.size(); ++i)
            for (const auto &[number, value] : parts_of(dofs[i]))
              parts.push_back({i, number, value});
          if (!parts.empty())
            f(cell, parts);
        }
    }

    const Space<dim> &space;
    const Numbers     numbers;

  private:
    dealii::AffineConstraints<double> hanging;
  };
} // namespace Crevasse

#endif
