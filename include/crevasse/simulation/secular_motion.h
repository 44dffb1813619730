// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_simulation_secular_motion_h
#define crevasse_simulation_secular_motion_h

#include <crevasse/base/format.h>
#include <crevasse/base/state_archive.h>
#include <crevasse/simulation/run.h>

namespace Crevasse
{
  /**
   * Gain of displacement from period to period: measured over the last period,
   * with periodic stress or not, and its limit, the flow β of the secular
   * problem, if that is solved.
   *
   * Also t₀, the time after which the contact conditions of the whole
   * displacement u = βt + q agree with those of the periodic part q (paper,
   * §5.1 and the comment on P2): nodes of the lip that the flow opens, β_N > 0,
   * are free in the periodic state, but touch while β_N t is less than the
   * oscillation of q. The constant in q is arbitrary; with zero mean as in the
   * paper,
   *
   *     t₀ = max (gap − min q_N) / β_N     over these nodes, at least 0.
   */
  template <int dim>
  class SecularMotion : public Observer
  {
  public:
    /** @param run before the first period on this mesh; it must outlive the
     * SecularMotion. */
    explicit SecularMotion(const Run<dim> &run)
      : run(run)
      , communicator(run.body.space.communicator())
      , follows_lip(run.body.effects.contact.on && run.flow &&
                    !run.state.has_begun()) // first mesh only
    {
      if (!follows_lip)
        return;
      const auto  rates = run.body.lip.opening_rates(run.flow->velocity);
      const auto &nodes = run.body.lip.nodes;
      for (unsigned int k = 0; k < nodes.size(); ++k)
        if (const double rate = rates[nodes[k].number]; rate > 0.)
          opening_nodes.push_back({k, rate});
    }

    void
    observe(const Sample &sample) override
    {
      if (sample.step == 0)
        start = sample.state.displacement;
      else if (sample.step == run.steps.n_steps())
        {
          gain = sample.state.displacement;
          gain -= start;
          if (sample.secular_flow != nullptr)
            gain.add(run.steps.period(), sample.secular_flow->velocity);
        }
      if (follows_lip)
        observe_lip(sample);
    }

    void
    serialize(StateArchive &archive) override
    {
      archive.section("secular motion");
      archive.nodal(start);
      if (!follows_lip)
        return;
      for (double OpeningNode::*entry :
           {&OpeningNode::least, &OpeningNode::integral, &OpeningNode::last})
        {
          std::vector<double> values(run.body.lip.nodes.size());
          for (const OpeningNode &node : opening_nodes)
            values[node.index] = node.*entry;
          archive.on_bounds(values);
          for (OpeningNode &node : opening_nodes)
            node.*entry = values[node.index];
        }
      archive.common(last_instant);
      archive.maximum(last_pressed);
      archive.part_of_sum(last_force);
      archive.part_of_sum(impulse);
    }

    /** Adds "drift" and "secular" to summary.json. */
    void
    summarise(Summary &summary) override
    {
      const Effects &effects = run.body.effects;
      Summary        drift;
      Summary        secular = {{"on", run.split.effect.on},
                                {"why", run.split.effect.why}};
      if (effects.viscosity.on)
        {
          const double largest  = run.body.space.largest_component(gain);
          const double per_time = // nan: unknown
            is_noise(largest) ? NAN : 1. / run.steps.period();
          drift["largest_rate"] = largest * per_time;
          for (const auto &probe : run.probes)
            drift["per_probe"][probe.name()] =
              components(probe.displacement(gain) * per_time);
          if (effects.contact.on)
            {
              // Largest closing of a node of the lip; β closes none.
              double closing = 0.;
              for (const LipNode<dim> &node : run.body.lip.nodes)
                closing = std::max(closing, -node.normal_part(gain));
              closing = dealii::Utilities::MPI::max(closing, communicator);
              drift["largest_closing_rate"] =
                is_noise(closing) ? NAN : closing / run.steps.period();
            }
          if (follows_lip)
            summarise_lip(secular);
          if (run.flow)
            summarise_flow(secular);
          const auto complete = [&](Summary &gain_of, Summary &flow_of) {
            if (!run.flow)
              flow_of = gain_of;
            else if (is_noise(largest))
              gain_of = flow_of;
          };
          complete(drift["largest_rate"], secular["largest_rate"]);
          for (const auto &probe : run.probes)
            complete(drift["per_probe"][probe.name()],
                     secular["per_probe"][probe.name()]["beta"]);
          summary["drift"] = drift;
        }
      summary["secular"] = secular;
    }

    /** Drift q(T n) − q(T (n−1)) after the run; 0 in constrained entries. */
    const Vector &
    drift() const
    {
      return gain;
    }

  private:
    /** A node that the flow opens, β_N > 0. */
    struct OpeningNode
    {
      unsigned int index; ///< index in the lip
      double       rate;  ///< rate β_N
      // Least value, integral and last value of q_N in this period.
      double least = 0., integral = 0., last = 0.;
    };

    static std::vector<double>
    components(const dealii::Tensor<1, dim> &tensor)
    {
      return {tensor.begin_raw(), tensor.end_raw()};
    }

    void
    observe_lip(const Sample &sample)
    {
      constexpr double rounding = 1e-9; // relative to the loads
      const double pressing = rounding * sample.right_hand_side.linfty_norm();
      const bool   is_whole = sample.secular_flow == nullptr;
      const auto  &nodes    = run.body.lip.nodes;
      const ContactForces &forces    = sample.state.contact_forces;
      const double         half_step = 0.5 * (sample.instant - last_instant);
      for (OpeningNode &opening : opening_nodes)
        {
          const LipNode<dim> &node = nodes[opening.index];
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
      const double force = run.body.lip.force(forces);
      impulse =
        sample.step == 0 ? 0. : impulse + half_step * (force + last_force);
      last_force   = force;
      last_instant = sample.instant;
    }

    /** Whether a displacement is within the accuracy of the solvers, as if
     * nothing flows, or at a lip that never opens. */
    bool
    is_noise(const double displacement) const
    {
      constexpr double some = 100.;
      return displacement <= some * run.systems.statistics().accuracy *
                               run.state.largest_displacement;
    }

    void
    summarise_flow(Summary &secular) const
    {
      const ContactForces &forces = run.flow->contact_forces;
      Vector               beta   = run.flow->velocity;
      // The flow is solved for separately: rounding of the mean load limits it.
      constexpr double rounding = 1e-12;
      if (run.body.space.largest_component(beta) * run.steps.period() <=
          rounding * run.state.largest_displacement)
        beta = 0.;
      secular["largest_rate"] = run.body.space.largest_component(beta);
      secular["contact_force"] =
        dealii::Utilities::MPI::sum(run.body.lip.force(forces), communicator);
      for (const auto &probe : run.probes)
        {
          auto        &entry    = secular["per_probe"][probe.name()];
          const double pressure = probe.pressure(forces);
          entry["beta"]         = components(probe.displacement(beta));
          if (probe.on_lip)
            entry["mean_pressure"] = pressure;
        }
    }

    /** Adds t₀, the last instant of contact of an opening node, and the mean
     * contact force over the last period, which in the periodic state is that
     * of the secular problem up to errors of steps, if η₀ is constant. */
    void
    summarise_lip(Summary &secular) const
    {
      double onset = 0.;
      for (const OpeningNode &opening : opening_nodes)
        {
          const double swing = opening.integral / last_instant - opening.least;
          const double gap   = run.body.lip.nodes[opening.index].gap;
          onset              = std::max(onset, (gap + swing) / opening.rate);
        }
      onset = dealii::Utilities::MPI::max(onset, communicator);
      const double pressed =
        dealii::Utilities::MPI::max(last_pressed, communicator);
      const auto number =
        dealii::Utilities::MPI::sum(opening_nodes.size(), communicator);

      secular["mean_contact_force_of_last_period"] =
        dealii::Utilities::MPI::sum(impulse, communicator) / last_instant;
      secular["opening_nodes"] = number;
      secular["onset"]         = onset;
      // null: no opening node was ever closed
      secular["last_contact_of_opening_nodes"] =
        pressed >= 0. ? Summary(pressed) : Summary();
      if (number > 0)
        run.log.line(Text::Message()
                     << "  the flow opens " << number
                     << " nodes of the lip: none touches after t_0 = " << onset
                     << " at the latest (q of mean value zero)");
    }

    const Run<dim> &run;
    const MPI_Comm  communicator;

    Vector start; ///< q at the period's start
    Vector gain;

    const bool               follows_lip;
    std::vector<OpeningNode> opening_nodes;
    double                   last_instant = 0.;
    /** Last instant of contact of an opening node; −1: never, or only q, with
     * another contact, was computed. */
    double last_pressed = -1.;
    double last_force = 0., impulse = 0.; ///< sums over this rank's nodes
  };
} // namespace Crevasse

#endif
