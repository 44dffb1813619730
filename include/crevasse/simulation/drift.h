// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#ifndef crevasse_simulation_drift_h
#define crevasse_simulation_drift_h

#include <crevasse/base/state_archive.h>
#include <crevasse/secular/onset.h>
#include <crevasse/simulation/run.h>

namespace Crevasse
{
  /**
   * Gain of displacement from period to period: measured over the last period,
   * with periodic stress or not, and its limit, the flow β of the secular
   * problem, if that is solved, with its onset.
   */
  template <int dim>
  class Drift : public Observer
  {
  public:
    /** @param run before the first period on this mesh; it must outlive this
     * object. */
    explicit Drift(const Run<dim> &run)
      : run(run)
    {
      if (run.body.effects.contact.on && run.flow &&
          !run.state.has_begun()) // first mesh only
        onset.emplace(run.body.lip, *run.flow);
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
      if (onset)
        onset->observe(sample);
    }

    void
    serialize(StateArchive &archive) override
    {
      archive.section("drift");
      archive.nodal(start);
      if (onset)
        onset->serialize(archive);
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
          Vector gain_per_time  = gain;
          gain_per_time *= per_time;
          for (const auto &probe : run.probes)
            drift["per_probe"][probe.name] =
              components(probe.velocity(gain_per_time));
          if (effects.contact.on)
            {
              const double closing = largest_closing();
              drift["largest_closing_rate"] =
                is_noise(closing) ? NAN : closing / run.steps.period();
            }
          if (onset)
            onset->summarise(secular, run.log);
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
            complete(drift["per_probe"][probe.name],
                     secular["per_probe"][probe.name]["beta"]);
          summary["drift"] = drift;
        }
      summary["secular"] = secular;
    }

    void
    require_periodic() const override
    {
      if (onset && !run.body.effects.varying_viscosity.on)
        require_contact_forces();
      if (run.body.effects.contact.on && run.body.effects.viscosity.on)
        require_lip_at_rest();
    }

    /** Gain q(T n) − q(T (n−1)) after the run; 0 in constrained entries. */
    const Vector &
    of_last_period() const
    {
      return gain;
    }

  private:
    static std::vector<double>
    components(const dealii::Tensor<1, dim> &tensor)
    {
      return {tensor.begin_raw(), tensor.end_raw()};
    }

    /** Largest closing of a node of the lip in the last period; β closes none.
     * Collective. */
    double
    largest_closing() const
    {
      double closing = 0.;
      for (const LipNode<dim> &node : run.body.lip.nodes)
        closing = std::max(closing, -node.normal_part(gain));
      return dealii::Utilities::MPI::max(closing,
                                         run.body.space.communicator());
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

    /** Largest component of a velocity, also where it is imposed. */
    double
    largest_rate(const Vector &velocity) const
    {
      Vector nodal = run.body.space.nodal_values(velocity);
      run.body.imposed.add_values(run.body.imposed.rates, nodal);
      return nodal.linfty_norm();
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
      secular["largest_rate"]  = largest_rate(beta);
      secular["contact_force"] = run.body.lip.force(forces);
      for (const auto &probe : run.probes)
        {
          auto        &entry    = secular["per_probe"][probe.name];
          const double pressure = probe.pressure(forces);
          entry["beta"]         = components(probe.velocity(beta));
          if (probe.on_lip)
            entry["mean_pressure"] = pressure;
        }
    }

    /** @param reason with advice. */
    [[noreturn]] void
    throw_another_state(const std::string &reason) const
    {
      throw NumericalError(
        "The stress repeats, but it is not the periodic one: " + reason +
        " march with [Periodic state] Tolerance = 0 over more periods" +
        (run.choice.alternative.empty() ? ""
                                        : ", or " + run.choice.alternative) +
        ". All results so far are written.");
    }

    void
    require_contact_forces() const
    {
      // The limits exceed the errors of reasonable steps, and the small part of
      // the load that a scheme's quadrature may miss; forces are accurate to
      // rounding.
      constexpr double far = 0.5, part_of_load = 0.05, rounding = 1e-10;
      const auto       n_nodes =
        dealii::Utilities::MPI::sum(run.body.lip.nodes.size(),
                                    run.body.space.communicator());
      const double measured   = onset->mean_contact_force();
      const double expected   = run.body.lip.force(run.flow->contact_forces);
      const double difference = std::abs(measured - expected);
      const double error = std::max(rounding, run.scene.contact.tolerance) *
                           run.magnitudes.largest_nodal_force * n_nodes;
      if (difference <= far * std::max(measured, expected) ||
          difference <= part_of_load * run.body.law.viscosity_factor(0.) *
                          run.split.mean_load.l1_norm() ||
          difference <= error)
        return;
      throw_another_state(
        Text::Message()
        << "the lip bears " << measured
        << " in the mean of the last period, and " << expected
        << " once its flow has become steady (mean contact force of the "
           "secular problem). The lip still approaches contact, still leaves "
           "it, or touches only within a step; raise [Time integration] "
           "Steps per period,");
    }

    void
    require_lip_at_rest() const
    {
      // The rest of the way to the periodic state closes the lip by about the
      // tolerance of the stress, relative to the opening.
      constexpr double many = 100., least_tolerance = 1e-8;
      const double     part =
        many * std::max(run.scene.periodic_state.tolerance, least_tolerance);
      const double closing = largest_closing();
      const double opening = run.state.largest_opening;
      if (is_noise(closing) || closing <= part * opening)
        return;
      throw_another_state(
        Text::Message()
        << "the lip continues to close, by up to " << closing
        << " in the last period, of an opening of " << opening
        << " at most. Once it touches, the stress will change;");
    }

    const Run<dim> &run;

    Vector start; ///< q at the period's start
    Vector gain;

    std::optional<SecularOnset<dim>> onset; ///< none: lip is not followed
  };
} // namespace Crevasse

#endif
