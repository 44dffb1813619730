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
          for (const auto &probe : run.probes)
            drift["per_probe"][probe.name] =
              components(probe.displacement(gain) * per_time);
          if (effects.contact.on)
            {
              // Largest closing of a node of the lip; β closes none.
              double closing = 0.;
              for (const LipNode<dim> &node : run.body.lip.nodes)
                closing = std::max(closing, -node.normal_part(gain));
              closing =
                dealii::Utilities::MPI::max(closing,
                                            run.body.space.communicator());
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
      secular["largest_rate"]  = run.body.space.largest_component(beta);
      secular["contact_force"] = run.body.lip.force(forces);
      for (const auto &probe : run.probes)
        {
          auto        &entry    = secular["per_probe"][probe.name];
          const double pressure = probe.pressure(forces);
          entry["beta"]         = components(probe.displacement(beta));
          if (probe.on_lip)
            entry["mean_pressure"] = pressure;
        }
    }

    const Run<dim> &run;

    Vector start; ///< q at the period's start
    Vector gain;

    std::optional<SecularOnset<dim>> onset; ///< none: lip is not followed
  };
} // namespace Crevasse

#endif
