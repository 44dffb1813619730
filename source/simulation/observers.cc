// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/discretisation/rigid_modes.h>
#include <crevasse/model/largest_load.h>
#include <crevasse/postprocess/crack_front_table.h>
#include <crevasse/postprocess/crack_tip_table.h>
#include <crevasse/postprocess/creep_integral_table.h>
#include <crevasse/postprocess/field_writer.h>
#include <crevasse/postprocess/mixed_mode_table.h>
#include <crevasse/postprocess/probe_tables.h>
#include <crevasse/postprocess/slip_while_closed.h>
#include <crevasse/postprocess/stress_writer.h>
#include <crevasse/simulation/elastic_comparison.h>
#include <crevasse/simulation/observers.h>
#include <crevasse/simulation/secular_motion.h>
#include <crevasse/simulation/tables.h>

namespace Crevasse
{
  using namespace dealii;

  namespace
  {
    /** Records the largest stress, displacement, opening and viscous strain of
     * a run, or of its last period, and the rounding of the stress. */
    template <int dim>
    class Extremes : public Observer
    {
    public:
      /** Updates the largest values in the state of the run, also after other
       * meshes. */
      explicit Extremes(Workspace<dim> &work)
        : work(work)
        , body(work.setup.body)
        , run(work.state)
      {
      }

      void
      observe(const Sample &sample) override
      {
        if (work.start.choice.periods_are_iterates() && sample.step == 0)
          run.largest_displacement = run.largest_opening = viscous_strain = 0.;
        const State &state = sample.state;
        run.largest_displacement =
          std::max(run.largest_displacement,
                   body.space.largest_component(state.displacement));
        if (sample.viscous_strain.size() > 0)
          viscous_strain =
            std::max(viscous_strain, sample.viscous_strain.linfty_norm());
        if (body.effects.contact.on)
          lip = body.lip.totals(state.displacement, state.contact_forces);
        run.largest_opening =
          std::max(run.largest_opening, lip.largest_opening);
      }

      void
      before_jump(const Sample &sample) override
      {
        observe(sample);
      }

      void
      end_of_period(const PeriodReport &report) override
      {
        run.largest_stress = std::max(work.start.choice.periods_are_iterates()
                                        ? 0.
                                        : run.largest_stress,
                                      report.largest_stress);
      }

      void
      serialize(StateArchive &archive) override
      {
        archive.common(viscous_strain);
      }

      /** Adds "extremes". "stress_rounding" is relative to the maximum: stress
       * is K times the small difference of strains that may be large. */
      void
      summarise(Summary &summary) override
      {
        Summary &extremes         = summary["extremes"];
        extremes["stress"]        = run.largest_stress;
        extremes["displacement"]  = run.largest_displacement;
        constexpr double small    = 0.1;
        const double     diagonal = RigidParts<dim>(body.space.mesh()).size();
        if (run.largest_displacement > small * diagonal)
          work.output.log.line(
            Text::Message()
            << "  Beware: displacements reach " << run.largest_displacement
            << " in a body of diagonal " << diagonal
            << ": the theory is for small strains. Check that loads, lengths "
               "and moduli use one system of units, and that the body may "
               "creep this long.");
        if (body.effects.contact.on)
          extremes["opening"] = run.largest_opening;
        if (!body.effects.viscosity.on)
          return;
        double     stiffness = 0.;
        const auto material  = body.material.at(0.);
        for (const VoigtMatrix<dim> &K : material.stiffness->distinct())
          stiffness = std::max(stiffness, K.norm());
        stiffness = Utilities::MPI::max(stiffness, body.space.communicator());
        summary["certificate"]["stress_rounding"] =
          run.largest_stress == 0.
            ? 0.
            : std::numeric_limits<double>::epsilon() * stiffness *
                viscous_strain / run.largest_stress;
      }

      LipTotals lip; ///< state at the last sample

    private:
      const Workspace<dim> &work;
      const Body<dim>      &body;
      RunState             &run;
      double                viscous_strain = 0.; ///< its largest component
    };



    /** A table with one row for each accepted step. */
    class SampleTable : public Observer
    {
    public:
      /** Computes a row. Collective, also on ranks that do not write. */
      using Row = std::function<std::vector<double>(const Sample &)>;

      SampleTable(CsvTable &&table, const Row &row)
        : table(std::move(table))
        , row(row)
      {
      }

      void
      observe(const Sample &sample) override
      {
        table.add_row(row(sample));
      }

    private:
      CsvTable  table;
      const Row row;
    };



    /** periods.csv: convergence to the periodic state, and its cost. The rows
     * are also logged, with a progress line on terminals. */
    class PeriodTable : public Observer
    {
    public:
      PeriodTable(CsvTable       &&table,
                  const Scene     &scene,
                  const LipTotals &lip,
                  Log             &log)
        : table(std::move(table))
        , scene(scene)
        , lip(lip)
        , log(log)
      {
        log.line("\n  period        t  change of stress  estimated error  VIs");
      }

      void
      observe(const Sample &sample) override
      {
        if (!log.on_terminal())
          return;
        const double done = // periods done
          sample.period - 1. + sample.instant / scene.loads.period;
        if (done_before < 0.)
          done_before = done;
        // Limits progress to a few lines a second.
        const double seconds = timer.wall_time();
        if (seconds <= last_shown + 0.2)
          return;
        last_shown        = seconds;
        const double most = scene.periodic_state.maximum_periods;
        const double now  = done - done_before;
        log.progress(Text::format(
          "  period %u of at most %.0f, step %u at t = %g, %u of the lip's "
          "nodes closed, at most %.0f s left",
          sample.period,
          most,
          sample.step + 1,
          sample.time,
          lip.closed_nodes,
          now > 0. ? seconds * (most - done) / now : 0.));
      }

      void
      end_of_period(const PeriodReport &report) override
      {
        table.add_row({double(report.period),
                       report.end_time,
                       report.stress_change,
                       report.stress_error_estimate,
                       double(report.vi_solves),
                       report.seconds});
        // The first period has no period before to compare its stress with, and
        // adaptive steps may differ from those of the period before.
        const auto shown =
          [](const char *pattern, const double value, const bool is_known) {
            return is_known && std::isfinite(value)
                     ? Text::format(pattern, value)
                     : "-";
          };
        log.line(Text::format(
          "  %6u %8g  %16s  %15s %4zu",
          report.period,
          report.end_time,
          shown("%.6e", report.stress_change, report.period > 1).c_str(),
          shown("%.1e", report.stress_error_estimate, true).c_str(),
          report.vi_solves));
      }

    private:
      CsvTable         table;
      const Scene     &scene;
      const LipTotals &lip;
      Log             &log;
      const Timer      timer;
      double           last_shown  = 0.;
      double           done_before = -1.; ///< before this mesh or resume
    };
  } // namespace



  template <int dim>
  std::vector<std::unique_ptr<Observer>>
  make_observers(Workspace<dim> &work)
  {
    const RunSetup<dim> &setup = work.setup;
    const Body<dim>     &body  = setup.body;
    Log                 &log   = work.output.log;

    std::vector<std::unique_ptr<Observer>> all;
    const auto                             add = [&all](auto observer) {
      const auto view = observer.get();
      all.push_back(std::move(observer));
      return view;
    };
    Tables tables(work);

    const auto extremes = add(std::make_unique<Extremes<dim>>(work));
    // The end of the run is always included.
    FieldInstants instants{false, {work.steps.period()}, {}};
    const auto    follow_tip = [&instants](const auto number, const auto tip) {
      for (const double sign : {1., -1.})
        instants.followed.emplace_back(
          [tip, number, sign](auto &) { return sign * tip->latest().*number; });
    };
    if (setup.crack_tips.empty())
      instants.followed.emplace_back(
        [](const Sample &sample) { return sample.state.stress.linfty_norm(); });
    std::vector<CsvTable> of_probes;
    for (const ProbeEvaluator<dim> &probe : setup.probes)
      of_probes.push_back(
        tables.table("probe_" + probe.name() + ".csv", probe.columns()));
    if (!of_probes.empty())
      add(std::make_unique<ProbeTables<dim>>(setup.probes,
                                             std::move(of_probes),
                                             body.space.communicator()));
    LipClosure<dim> *closure = nullptr;
    if (body.effects.contact.on)
      {
        const LipTotals &lip = extremes->lip;
        add(std::make_unique<SampleTable>(
          tables.table("contact.csv",
                       {"t", "closed_nodes", "force", "largest_pressure"}),
          [&lip](const Sample &sample) -> std::vector<double> {
            return {sample.time,
                    double(lip.closed_nodes),
                    lip.force,
                    lip.largest_pressure};
          }));
        closure = add(std::make_unique<LipClosure<dim>>(body,
                                                        tables.path("lip.csv"),
                                                        work.evolution));
        instants.followed.emplace_back(
          [&lip](auto &) { return lip.largest_opening; });
        instants.followed.emplace_back(
          [&lip](auto &) { return lip.closed_nodes > 0 ? lip.force : NAN; });
      }
    if (!body.space.roles.crack.empty())
      add(std::make_unique<SlipWhileClosed<dim>>(body, log));
    const auto motion = add(std::make_unique<SecularMotion<dim>>(work));
    if (setup.load_factors)
      add(std::make_unique<ElasticComparison<dim>>(work, motion->drift()));
    if constexpr (dim == 2)
      if (!setup.crack_tips.empty())
        {
          const auto squares =
            elastic_error_squares(setup.scene, body, work.systems, work.steps);
          const TipContext context{work.steps, work.start.flow, closure, log};
          unsigned int     number = 0;
          for (const auto &tip : setup.crack_tips)
            if (tip->intensity.region.tip.two_lips)
              follow_tip(&MixedModeValues::equivalent,
                         add(std::make_unique<MixedModeTable>(
                           *tip,
                           squares,
                           context,
                           tables.table("crack_tip_" +
                                          std::to_string(++number) + ".csv",
                                        MixedModeTable::columns(*tip)))));
            else
              follow_tip(&CrackTipValues::intensity,
                         add(std::make_unique<CrackTipTable>(
                           *tip,
                           squares,
                           context,
                           tables.table("crack_tip.csv",
                                        CrackTipTable::columns(*tip)))));
        }
    if constexpr (dim == 2)
      for (unsigned int i = 0; i < setup.creep_integrals.size(); ++i)
        {
          const CreepIntegral &integral = *setup.creep_integrals[i];
          const std::string    number =
            integral.region.tip.two_lips ? "_" + std::to_string(i + 1) : "";
          add(std::make_unique<CreepIntegralTable>(
            setup.scene,
            integral,
            work.steps,
            work.start.choice.periods_are_iterates(),
            tables.table("creep_integral" + number + ".csv",
                         {"t", "C_t", "C_t_error"}),
            log));
        }
    if (setup.crack_front != nullptr)
      add(std::make_unique<CrackFrontTable>(
        *setup.crack_front, work.steps, tables.path("crack_front.csv"), log));
    if (body.effects.field_output.on)
      {
        const FieldTimes &times = *setup.scene.output.field_times;
        instants.all            = times.all;
        if (!times.of_extremes)
          instants.followed.clear();
        for (const double t : times.instants(work.steps.period()))
          instants.chosen.insert(work.steps.instant(work.steps.nearest(t)));
        add(std::make_unique<FieldWriter<dim>>(body,
                                               setup.recovery,
                                               work.steps,
                                               instants,
                                               work.output.directory,
                                               log));
      }
    if (setup.scene.output.load_work)
      // Work of the loads ∫ loads · u (force times length, per thickness in a
      // plane). For an elastic body without gap, half of it is the strain
      // energy, and minus this half the least potential energy, the reference
      // for errors in the energy norm.
      add(std::make_unique<SampleTable>(
        tables.table("load_work.csv", {"t", "load_work"}),
        [&work](const Sample &sample) -> std::vector<double> {
          const double t = work.steps.within_period(sample.instant);
          return {sample.time,
                  loads_at(work.setup.body, t) * sample.state.displacement};
        }));
    if (work.output.stress_record)
      add(std::make_unique<StressWriter<dim>>(body,
                                              work.output.directory +
                                                "/stress_samples.bin"));
    add(std::make_unique<PeriodTable>(tables.table("periods.csv",
                                                   {"period",
                                                    "t_end",
                                                    "stress_change",
                                                    "stress_error_estimate",
                                                    "vi_solves",
                                                    "seconds"}),
                                      setup.scene,
                                      extremes->lip,
                                      log));
    work.output.checkpoints.set_tables(tables.names);
    return all;
  }



  template std::vector<std::unique_ptr<Observer>>
  make_observers(Workspace<2> &);
  template std::vector<std::unique_ptr<Observer>>
  make_observers(Workspace<3> &);
} // namespace Crevasse
