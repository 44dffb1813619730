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
  /** The crack lip at one instant, over all ranks. */
  struct LipState
  {
    unsigned int closed_nodes     = 0;  ///< of the free ones
    double       force            = 0.; ///< ∫ pressure, held nodes included
    double       largest_pressure = 0.; ///< g / weight
    double       largest_opening  = 0.; ///< u_N − gap
  };

  /** ∫ pressure over the nodes of this rank, with the shares of held ones.
   *
   * @param forces of these nodes. */
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

  /** A node is closed where its opening vanishes against the largest
   * displacement of the body: up to this one. With no displacement at all the
   * lip touches. Collective. */
  inline double
  largest_opening_of_closed(const State &state)
  {
    return 1e-10 * state.displacement.linfty_norm();
  }

  /** Collective. */
  template <int dim>
  LipState
  lip_state(const ContactBoundary<dim> &lip, const State &state)
  {
    const MPI_Comm communicator = state.displacement.get_mpi_communicator();
    const double   touching     = largest_opening_of_closed(state);

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
    dealii::Utilities::MPI::sum(sums, communicator, sums);
    dealii::Utilities::MPI::max(maxima, communicator, maxima);
    return {static_cast<unsigned int>(sums[0]), sums[1], maxima[0], maxima[1]};
  }

  /** The largest component at the nodes, where singular functions vanish: of
   * unknowns that are displacements and of those that the lips' are combined
   * to, see LipBasis. Collective. */
  template <int dim>
  double
  largest_displacement(const Space<dim> &space, const Vector &displacement)
  {
    double largest = 0.;
    for (std::size_t i = 0; i < space.dof_handler.n_locally_owned_dofs(); ++i)
      largest = std::max(largest, std::abs(displacement.local_element(i)));
    std::vector<double> combined; // each rank adds what it has
    for (const auto &[dof, weights] : space.lip.combinations)
      {
        combined.push_back(0.);
        for (const auto &[unknown, weight] : weights)
          if (displacement.in_local_range(unknown))
            combined.back() += weight * displacement(unknown);
      }
    dealii::Utilities::MPI::sum(combined, space.communicator(), combined);
    for (const double value : combined)
      largest = std::max(largest, std::abs(value));
    return dealii::Utilities::MPI::max(largest, space.communicator());
  }
} // namespace Crevasse

#endif
