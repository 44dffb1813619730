// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/periodic/net_slip.h>

namespace Crevasse
{
  using namespace dealii;

  template <int dim>
  NetSlip<dim>::NetSlip(const ContactBoundary<dim> &lip)
    : lip(lip)
    , begin(dim - 1, std::vector<double>(lip.nodes.size()))
    , net(begin)
  {
  }



  template <int dim>
  void
  NetSlip<dim>::observe(const Sample &sample)
  {
    const Jumps &jumps = sample.state.friction.reference;
    if (sample.step == 0)
      {
        if (n_begun > 0)
          end_period(jumps, sample.state.displacement.linfty_norm());
        begin = jumps;
        ++n_begun;
      }
    for (unsigned int k = 0; k < lip.nodes.size(); ++k)
      {
        const LipNode<dim> &node = lip.nodes[k];
        largest =
          std::max(largest,
                   std::abs(node.normal_part(sample.state.displacement)));
        for (unsigned int c = 0; c < dim - 1; ++c)
          largest = std::max(largest, std::abs(jumps[c][k] - begin[c][k]));
      }
  }



  template <int dim>
  void
  NetSlip<dim>::end_period(const Jumps &jumps,
                           const double largest_displacement)
  {
    double sizes[] = {0., 0.}; // net slip and its change
    for (unsigned int c = 0; c < dim - 1; ++c)
      for (unsigned int k = 0; k < lip.nodes.size(); ++k)
        {
          const double slip   = jumps[c][k] - begin[c][k];
          const double change = slip - net[c][k];
          net[c][k]           = slip;
          sizes[0]            = std::max(sizes[0], std::abs(slip));
          sizes[1]            = std::max(sizes[1], std::abs(change));
        }
    Utilities::MPI::max(sizes, lip.communicator(), sizes);
    const double whole    = scale();
    const auto   relative = [whole](const double length) {
      return whole > 0. ? length / whole : 0.;
    };
    constexpr double digits   = 1e-9; // of displacements
    const double     rounding = relative(digits * largest_displacement);
    const double     if_vanishing =
      vanishing.add(relative(sizes[0]), true, rounding);
    // The first net slip has none before it.
    const double if_repeating =
      repeating.add(relative(sizes[1]), n_begun > 1, rounding);
    estimate = std::fmin(if_vanishing, if_repeating); // the one that is no nan
  }



  template <int dim>
  void
  NetSlip<dim>::serialize(StateArchive &archive)
  {
    archive.section("net slip");
    for (Jumps *list : {&begin, &net})
      for (std::vector<double> &along : *list)
        archive.on_bounds(along);
    archive.common(n_begun);
    archive.maximum(largest);
    archive.common(estimate);
    vanishing.serialize(archive);
    repeating.serialize(archive);
  }



  template class NetSlip<2>;
  template class NetSlip<3>;
} // namespace Crevasse
