// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/base/state_archive.h>
#include <crevasse/postprocess/contact_onset.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <sstream>

namespace Crevasse
{
  using namespace dealii;

  template <int dim>
  ContactOnset<dim>::ContactOnset(const ContactBoundary<dim> &lip,
                                  const SecularFlow          &flow,
                                  Log                        &log)
    : lip(lip)
    , communicator(flow.velocity.get_mpi_communicator())
    , log(log)
  {
    constexpr double rounding = 1e-10;
    const double     opens    = rounding * flow.velocity.linfty_norm();
    for (unsigned int k = 0; k < lip.nodes().size(); ++k)
      secular_force += flow.contact_forces[k];
    for (unsigned int k = 0; k < lip.nodes().size(); ++k)
      {
        const LipNode<dim> &node = lip.nodes()[k];
        const double        rate = node.sign * flow.velocity(node.dof);
        if (rate > opens)
          nodes.push_back({k, rate});
      }
  }



  template <int dim>
  void
  ContactOnset<dim>::observe(const Sample &sample)
  {
    constexpr double rounding = 1e-9; // of the forces that are in balance
    const double     pressing = rounding * sample.right_hand_side.linfty_norm();
    const double     flown = sample.secular_flow == nullptr ? sample.time : 0.;
    for (OpeningNode &opening : nodes)
      {
        const LipNode<dim> &node = lip.nodes()[opening.index];
        const double q = node.sign * sample.state.displacement(node.dof) -
                         flown * opening.rate;
        if (sample.step == 0)
          {
            opening.least    = q;
            opening.integral = 0.;
          }
        else
          {
            opening.least = std::min(opening.least, q);
            opening.integral +=
              0.5 * (sample.instant - last_instant) * (q + opening.last);
          }
        opening.last = q;
        if (sample.secular_flow == nullptr &&
            sample.state.contact_forces[opening.index] > pressing)
          pressed = sample.time;
      }
    double force = 0.;
    for (unsigned int k = 0; k < lip.nodes().size(); ++k)
      force += sample.state.contact_forces[k];
    if (sample.step == 0)
      impulse = 0.;
    else
      impulse += 0.5 * (sample.instant - last_instant) * (force + last_force);
    last_force   = force;
    last_instant = sample.instant;
  }



  template <int dim>
  void
  ContactOnset<dim>::serialize(StateArchive &archive)
  {
    archive.section("contact onset");
    for (double OpeningNode::*entry :
         {&OpeningNode::least, &OpeningNode::integral, &OpeningNode::last})
      {
        std::vector<double> values(lip.nodes().size());
        for (const OpeningNode &node : nodes)
          values[node.index] = node.*entry;
        archive.on_bounds(values);
        for (OpeningNode &node : nodes)
          node.*entry = values[node.index];
      }
    archive.common(last_instant);
    archive.maximum(pressed);
    archive.part_of_sum(last_force);
    archive.part_of_sum(impulse);
  }



  template <int dim>
  void
  ContactOnset<dim>::summarise(Summary &summary)
  {
    const unsigned int n_nodes = n_opening_nodes();
    const double       pressed = last_contact();

    auto &secular                                = summary["secular"];
    secular["mean_contact_force_of_last_period"] = mean_forces().first;
    secular["opening_nodes"]                     = n_nodes;
    secular["onset"]                             = onset();
    // null: none of them was pressed at all
    secular["last_contact_of_opening_nodes"] =
      pressed >= 0. ? Summary(pressed) : Summary();
    if (n_nodes == 0)
      return;
    std::ostringstream text;
    text << "  the flow opens " << n_nodes
         << " nodes of the lip: none touches after t_0 = " << onset()
         << " at the latest (q of mean value zero)";
    log.line(text.str());
  }



  template <int dim>
  unsigned int
  ContactOnset<dim>::n_opening_nodes() const
  {
    return Utilities::MPI::sum(static_cast<unsigned int>(nodes.size()),
                               communicator);
  }



  template <int dim>
  double
  ContactOnset<dim>::onset() const
  {
    double latest = 0.;
    for (const OpeningNode &opening : nodes)
      {
        const double swing = opening.integral / last_instant - opening.least;
        latest =
          std::max(latest,
                   (lip.nodes()[opening.index].gap + swing) / opening.rate);
      }
    return Utilities::MPI::max(latest, communicator);
  }



  template <int dim>
  std::pair<double, double>
  ContactOnset<dim>::mean_forces() const
  {
    return {Utilities::MPI::sum(impulse, communicator) / last_instant,
            Utilities::MPI::sum(secular_force, communicator)};
  }



  template <int dim>
  double
  ContactOnset<dim>::last_contact() const
  {
    return Utilities::MPI::max(pressed, communicator);
  }



  template class ContactOnset<2>;
  template class ContactOnset<3>;
} // namespace Crevasse
