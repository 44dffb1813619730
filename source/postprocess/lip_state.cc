// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/postprocess/lip_state.h>

#include <deal.II/base/mpi.h>

#include <algorithm>

namespace Crevasse
{
  using namespace dealii;

  template <int dim>
  double
  contact_force(const ContactBoundary<dim> &lip,
                const std::vector<double>  &forces)
  {
    double sum = 0.;
    for (unsigned int k = 0; k < lip.nodes.size(); ++k)
      sum += lip.nodes[k].force(forces[k]);
    return sum;
  }



  template <int dim>
  LipState
  lip_state(const ContactBoundary<dim> &lip, const State &state)
  {
    const MPI_Comm communicator = state.displacement.get_mpi_communicator();
    const double   touching     = 1e-10 * state.displacement.linfty_norm();

    std::vector<double> sums = {0., contact_force(lip, state.contact_forces)};
    std::vector<double> maxima(2);
    for (unsigned int k = 0; k < lip.nodes.size(); ++k)
      {
        const LipNode<dim> &node    = lip.nodes[k];
        const double        g       = state.contact_forces[k];
        const double        opening = node.opening(state.displacement);
        sums[0] += opening <= touching ? 1. : 0.;
        maxima[0] = std::max(maxima[0], g / node.weight);
        maxima[1] = std::max(maxima[1], opening);
      }
    Utilities::MPI::sum(sums, communicator, sums);
    Utilities::MPI::max(maxima, communicator, maxima);
    return {static_cast<unsigned int>(sums[0]), sums[1], maxima[0], maxima[1]};
  }



  template double
  contact_force<2>(const ContactBoundary<2> &, const std::vector<double> &);
  template double
  contact_force<3>(const ContactBoundary<3> &, const std::vector<double> &);
  template LipState
  lip_state<2>(const ContactBoundary<2> &, const State &);
  template LipState
  lip_state<3>(const ContactBoundary<3> &, const State &);
} // namespace Crevasse
