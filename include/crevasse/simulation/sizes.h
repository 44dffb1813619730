// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_simulation_sizes_h
#define crevasse_simulation_sizes_h

#include <crevasse/base/log.h>
#include <crevasse/base/summary.h>
#include <crevasse/simulation/run_setup.h>

namespace Crevasse
{
  /** How large a discretised body is. */
  struct Sizes
  {
    dealii::types::global_dof_index cells;
    dealii::types::global_dof_index unknowns;
    std::size_t                     quadrature_points;
    std::size_t                     contact_nodes;
    std::vector<unsigned int>       cells_of_ranks; ///< on the first rank
    unsigned int                    levels; ///< of cells, the coarse included
    double smallest_cell, largest_cell;     ///< their longest diagonals

    /** Collective. */
    template <int dim>
    explicit Sizes(const Body<dim> &body);

    void
    add_to(Summary &summary) const;
  };

  /** Prints sizes and the memory that the run is going to need. Collective.
   * @throw SceneError if that is more than there is. */
  template <int dim>
  void
  describe_sizes(const RunSetup<dim> &setup, Log &log);
} // namespace Crevasse

#endif
