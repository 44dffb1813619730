// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_postprocess_lip_state_h
#define crevasse_postprocess_lip_state_h

#include <crevasse/discretisation/contact_boundary.h>
#include <crevasse/time/state.h>

#include <deal.II/base/mpi.h>

#include <algorithm>

namespace Crevasse
{
  /** State of the crack lip at one instant, over all ranks. */
  struct LipState
  {
    unsigned int closed_nodes     = 0;  ///< closed free nodes
    double       force            = 0.; ///< force ∫ pressure, with held nodes
    double       largest_pressure = 0.;
    double       largest_opening  = 0.; ///< largest u_N − gap
  };

  /** Contact force ∫ pressure over the nodes of this rank, with held nodes.
   *
   * @param forces contact forces of these nodes. */
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

  /** Rate β_N of each node that the flow opens for good; 0 for other nodes.
   * Collective. */
  template <int dim>
  std::vector<double>
  opening_rates(const ContactBoundary<dim> &lip, const Vector &velocity)
  {
    const double opens = 1e-10 * velocity.linfty_norm(); // beyond rounding
    std::vector<double> rates;
    for (const LipNode<dim> &node : lip.nodes)
      {
        const double rate = node.sign * velocity(node.dof);
        rates.push_back(rate > opens ? rate : 0.);
      }
    return rates;
  }

  /** Computes the state of the lip over all ranks. Collective. */
  template <int dim>
  LipState
  lip_state(const ContactBoundary<dim> &lip, const State &state)
  {
    const MPI_Comm communicator = state.displacement.get_mpi_communicator();
    std::vector<double> sums = {0., contact_force(lip, state.contact_forces)};
    std::vector<double> maxima(2);
    for (const LipNodeState &node :
         lip.states(state.displacement, state.contact_forces))
      {
        sums[0] += node.is_closed ? 1. : 0.;
        maxima[0] = std::max(maxima[0], node.pressure);
        maxima[1] = std::max(maxima[1], node.opening);
      }
    dealii::Utilities::MPI::sum(sums, communicator, sums);
    dealii::Utilities::MPI::max(maxima, communicator, maxima);
    return {static_cast<unsigned int>(sums[0]), sums[1], maxima[0], maxima[1]};
  }

  /** Largest displacement component at the nodes, where singular functions
   * vanish. Collective. */
  template <int dim>
  double
  largest_displacement(const Space<dim> &space, const Vector &displacement)
  {
    return space.nodal_values(displacement).linfty_norm();
  }
} // namespace Crevasse

#endif
