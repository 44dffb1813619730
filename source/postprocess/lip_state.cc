// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/postprocess/lip_state.h>

#include <deal.II/base/array_view.h>
#include <deal.II/base/mpi.h>

#include <algorithm>
#include <array>

namespace Crevasse
{
  using namespace dealii;

  template <int dim>
  LipState
  lip_state(const ContactBoundary<dim> &lip, const State &state)
  {
    const MPI_Comm communicator = state.displacement.get_mpi_communicator();
    const double   displacement = state.displacement.linfty_norm();
    const double   touching     = 1e-10 * displacement;

    LipState here;
    for (unsigned int k = 0; k < lip.nodes().size(); ++k)
      {
        const LipNode<dim> &node = lip.nodes()[k];
        const double        g    = state.contact_forces[k];
        const double        opening =
          node.sign * state.displacement(node.dof) - node.gap;
        if (opening <= touching)
          ++here.closed_nodes;
        here.force += node.force(g);
        here.largest_pressure =
          std::max(here.largest_pressure, g / node.weight);
        here.largest_opening = std::max(here.largest_opening, opening);
      }

    std::array<double, 2> sums{{double(here.closed_nodes), here.force}};
    std::array<double, 2> maxima{{here.largest_pressure, here.largest_opening}};
    Utilities::MPI::sum(ArrayView<const double>(sums.data(), sums.size()),
                        communicator,
                        ArrayView<double>(sums.data(), sums.size()));
    Utilities::MPI::max(ArrayView<const double>(maxima.data(), maxima.size()),
                        communicator,
                        ArrayView<double>(maxima.data(), maxima.size()));
    return {static_cast<unsigned int>(sums[0]),
            sums[1],
            maxima[0],
            maxima[1],
            displacement};
  }



  template LipState
  lip_state<2>(const ContactBoundary<2> &, const State &);
  template LipState
  lip_state<3>(const ContactBoundary<3> &, const State &);
} // namespace Crevasse
