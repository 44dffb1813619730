// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_secular_onset_h
#define crevasse_secular_onset_h

#include <crevasse/base/log.h>
#include <crevasse/base/text.h>
#include <crevasse/lip/contact_boundary.h>
#include <crevasse/time/observer.h>

namespace Crevasse
{
  /**
   * Finds t₀, the time after which the contact conditions of the whole
   * displacement u = βt + q agree with those of the periodic part q (paper,
   * §5.1 and the comment on P2): nodes of the lip that the flow opens, β_N > 0,
   * are free in the periodic state, but touch while β_N t is less than the
   * oscillation of q. The constant in q is arbitrary; with zero mean as in the
   * paper,
   *
   *     t₀ = max (gap − min q_N) / β_N     over these nodes, at least 0.
   */
  template <int dim>
  class SecularOnset
  {
  public:
    /** Collective.
     * @param lip Must outlive this object. */
    SecularOnset(const ContactBoundary<dim> &lip, const SecularFlow &flow)
      : lip(lip)
      , communicator(flow.velocity.get_mpi_communicator())
    {
      const auto rates = lip.opening_rates(flow.velocity);
      for (unsigned int k = 0; k < lip.nodes.size(); ++k)
        if (const double rate = rates[lip.nodes[k].number]; rate > 0.)
          opening_nodes.push_back({k, rate});
    }

    /** Records an instant. Collective. */
    void
    observe(const Sample &sample)
    {
      constexpr double rounding = 1e-9; // relative to the loads
      const double pressing = rounding * sample.right_hand_side.linfty_norm();
      const bool   is_whole = sample.secular_flow == nullptr;
      const ContactForces &forces    = sample.state.contact_forces;
      const double         half_step = 0.5 * (sample.instant - last_instant);
      for (OpeningNode &opening : opening_nodes)
        {
          const LipNode<dim> &node = lip.nodes[opening.index];
          const double        q = node.normal_part(sample.state.displacement) -
                           (is_whole ? sample.time * opening.rate : 0.);
          if (sample.step == 0)
            {
              opening.least    = q;
              opening.integral = 0.;
            }
          else
            {
              opening.least = std::min(opening.least, q);
              opening.integral += half_step * (q + opening.last);
            }
          opening.last = q;
          if (is_whole && forces.normal[opening.index] > pressing)
            last_pressed = sample.time;
        }
      const double force = lip.force(forces);
      impulse =
        sample.step == 0 ? 0. : impulse + half_step * (force + last_force);
      last_force   = force;
      last_instant = sample.instant;
    }

    void
    serialize(StateArchive &archive)
    {
      for (double OpeningNode::*entry :
           {&OpeningNode::least, &OpeningNode::integral, &OpeningNode::last})
        {
          std::vector<double> values(lip.nodes.size());
          for (const OpeningNode &node : opening_nodes)
            values[node.index] = node.*entry;
          archive.on_bounds(values);
          for (OpeningNode &node : opening_nodes)
            node.*entry = values[node.index];
        }
      archive.common(last_instant);
      archive.maximum(last_pressed);
      archive.common(last_force);
      archive.common(impulse);
    }

    /** Mean contact force over the last period. In the periodic state it is
     * that of the secular problem up to errors of steps, if η₀ is constant. */
    double
    mean_contact_force() const
    {
      return impulse / last_instant;
    }

    /** Adds t₀, the last instant of contact of an opening node, and the mean
     * contact force. Collective. */
    void
    summarise(Summary &secular, Log &log) const
    {
      double onset = 0.;
      for (const OpeningNode &opening : opening_nodes)
        {
          const double swing = opening.integral / last_instant - opening.least;
          const double gap   = lip.nodes[opening.index].gap;
          onset              = std::max(onset, (gap + swing) / opening.rate);
        }
      onset = dealii::Utilities::MPI::max(onset, communicator);
      const double pressed =
        dealii::Utilities::MPI::max(last_pressed, communicator);
      const auto number =
        dealii::Utilities::MPI::sum(opening_nodes.size(), communicator);

      secular["mean_contact_force_of_last_period"] = mean_contact_force();
      secular["opening_nodes"]                     = number;
      secular["onset"]                             = onset;
      // null: no opening node was ever closed
      secular["last_contact_of_opening_nodes"] =
        pressed >= 0. ? Summary(pressed) : Summary();
      if (number > 0)
        log.line(Text::Message()
                 << "  the flow opens " << number
                 << " nodes of the lip: none touches after t_0 = " << onset
                 << " at the latest (q of mean value zero)");
    }

  private:
    /** Node that the flow opens, β_N > 0. */
    struct OpeningNode
    {
      unsigned int index; ///< index in the lip
      double       rate;  ///< rate β_N
      // Least value, integral and last value of q_N in this period.
      double least = 0., integral = 0., last = 0.;
    };

    const ContactBoundary<dim> &lip;
    const MPI_Comm              communicator;
    std::vector<OpeningNode>    opening_nodes;
    double                      last_instant = 0.;
    /** Last instant of contact of an opening node; −1: never, or only q, with
     * another contact, was computed. */
    double last_pressed = -1.;
    double last_force = 0., impulse = 0.;
  };
} // namespace Crevasse

#endif
