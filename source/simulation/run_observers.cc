// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Crevasse authors

#include <crevasse/discretisation/rigid_modes.h>
#include <crevasse/model/largest_load.h>
#include <crevasse/postprocess/crack_front_table.h>
#include <crevasse/postprocess/creep_integral_table.h>
#include <crevasse/postprocess/field_writer.h>
#include <crevasse/postprocess/probe_tables.h>
#include <crevasse/postprocess/slip_while_closed.h>
#include <crevasse/postprocess/stress_writer.h>
#include <crevasse/postprocess/tip_table.h>
#include <crevasse/simulation/drift.h>
#include <crevasse/simulation/elastic_comparison.h>
#include <crevasse/simulation/run.h>

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
      explicit Extremes(Run<dim> &run)
        : run(run)
        , body(run.body)
        , state(run.state)
      {
      }

      void
      observe(const Sample &sample) override
      {
        if (run.choice.periods_are_iterates() && sample.step == 0)
          state.largest_displacement = state.largest_opening = viscous_strain =
            0.;
        const State &now = sample.state;
        state.largest_displacement =
          std::max(state.largest_displacement,
                   body.space.largest_component(now.displacement));
        if (sample.viscous_strain.size() > 0)
          viscous_strain =
            std::max(viscous_strain, largest_strain(sample.viscous_strain));
        if (body.effects.contact.on)
          lip = body.lip.totals(now.displacement, now.contact_forces);
        state.largest_opening =
          std::max(state.largest_opening, lip.largest_opening);
      }

      void
      before_jump(const Sample &sample) override
      {
        observe(sample);
      }

      void
      end_of_period(const PeriodReport &report) override
      {
        state.largest_stress =
          std::max(run.choice.periods_are_iterates() ? 0.
                                                     : state.largest_stress,
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
        extremes["stress"]        = state.largest_stress;
        extremes["displacement"]  = state.largest_displacement;
        constexpr double small    = 0.1;
        const double     diagonal = RigidParts<dim>(body.space.mesh()).size();
        if (state.largest_displacement > small * diagonal)
          run.log.line(
            Text::Message()
            << "  Beware: displacements reach " << state.largest_displacement
            << " in a body of diagonal " << diagonal
            << ": the theory is for small strains. Check that loads, lengths "
               "and moduli use one system of units, and that the body may "
               "creep this long.");
        if (body.effects.contact.on)
          extremes["opening"] = state.largest_opening;
        if (!body.effects.viscosity.on)
          return;
        double     stiffness = 0.;
        const auto material  = body.material.at(0.);
        for (const VoigtMatrix<dim> &K : material.stiffness->distinct())
          stiffness = std::max(stiffness, K.norm());
        stiffness = Utilities::MPI::max(stiffness, body.space.communicator());
        summary["certificate"]["stress_rounding"] =
          state.largest_stress == 0.
            ? 0.
            : std::numeric_limits<double>::epsilon() * stiffness *
                viscous_strain / state.largest_stress;
      }

      LipTotals lip; ///< state at the last sample

    private:
      double
      largest_strain(const Vector &r) const
      {
        if (!body.law.hardens())
          return r.linfty_norm();
        Vector strains = r;
        body.material.convert(&CreepPoint<dim>::strains, strains);
        return strains.linfty_norm();
      }

      const Run<dim>  &run;
      const Body<dim> &body;
      RunState        &state;
      double           viscous_strain = 0.; ///< its largest component
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
  void
  Run<dim>::make_observers()
  {
    const auto add = [this](auto observer) {
      const auto view = observer.get();
      observers.push_back(std::move(observer));
      return view;
    };
    const bool writes =
      Utilities::MPI::this_mpi_process(body.space.communicator()) == 0;
    // Ranks that do not write have no files.
    const auto path = [&](const std::string &name) {
      return writes ? checkpoints.directory + '/' + name : std::string();
    };
    std::vector<std::string> names; // of tables
    const auto               table = [&](const std::string              &name,
                           const std::vector<std::string> &columns) {
      names.push_back(name);
      return CsvTable(path(name), columns, state.has_tables());
    };

    const auto extremes = add(std::make_unique<Extremes<dim>>(*this));
    // The end of the run is always included.
    FieldInstants instants{false, {steps.period()}, {}};
    if (crack_tips.empty())
      instants.followed.emplace_back(
        [](const Sample &sample) { return sample.state.stress.linfty_norm(); });
    std::vector<CsvTable> of_probes;
    for (const ProbeEvaluator<dim> &probe : probes)
      of_probes.push_back(
        table("probe_" + probe.name + ".csv", probe.columns()));
    if (!of_probes.empty())
      add(std::make_unique<ProbeTables<dim>>(probes,
                                             std::move(of_probes),
                                             body.space.communicator()));
    LipClosure<dim> *closure = nullptr;
    if (body.effects.contact.on)
      {
        const LipTotals &lip = extremes->lip;
        add(std::make_unique<SampleTable>(
          table("contact.csv",
                {"t", "closed_nodes", "force", "largest_pressure"}),
          [&lip](const Sample &sample) -> std::vector<double> {
            return {sample.time,
                    double(lip.closed_nodes),
                    lip.force,
                    lip.largest_pressure};
          }));
        closure = add(
          std::make_unique<LipClosure<dim>>(body, path("lip.csv"), evolution));
        instants.followed.emplace_back(
          [&lip](auto &) { return lip.largest_opening; });
        instants.followed.emplace_back(
          [&lip](auto &) { return lip.closed_nodes > 0 ? lip.force : NAN; });
      }
    if (!body.space.roles.crack.empty())
      add(std::make_unique<SlipWhileClosed<dim>>(body, log));
    const auto drift = add(std::make_unique<Drift<dim>>(*this));
    if (load_factors)
      add(std::make_unique<ElasticComparison<dim>>(*this,
                                                   drift->of_last_period()));
    if constexpr (dim == 2)
      if (!crack_tips.empty())
        {
          const auto squares =
            elastic_error_squares(scene, body, systems, steps);
          const TipContext context{steps, flow, closure, log};
          unsigned int     n_two_lips = 0;
          for (const auto &tip : crack_tips)
            {
              const std::string number = tip->intensity.region.tip.two_lips
                                           ? "_" + std::to_string(++n_two_lips)
                                           : "";
              const auto        of_tip = add(std::make_unique<TipTable>(
                *tip,
                squares,
                context,
                table("crack_tip" + number + ".csv", TipTable::columns(*tip))));
              for (const double sign : {1., -1.})
                instants.followed.emplace_back([of_tip, sign](auto &) {
                  return sign * of_tip->latest().equivalent;
                });
            }
        }
    if constexpr (dim == 2)
      for (unsigned int i = 0; i < creep_integrals.size(); ++i)
        {
          const CreepIntegral &integral = *creep_integrals[i];
          const std::string    number =
            integral.region.tip.two_lips ? "_" + std::to_string(i + 1) : "";
          add(std::make_unique<CreepIntegralTable>(
            scene,
            integral,
            steps,
            choice.periods_are_iterates(),
            table("creep_integral" + number + ".csv",
                  {"t", "C_t", "C_t_error"}),
            log));
        }
    if (crack_front != nullptr)
      add(std::make_unique<CrackFrontTable>(
        *crack_front, steps, path("crack_front.csv"), log));
    if (body.effects.field_output.on)
      {
        const FieldTimes &times = *scene.output.field_times;
        instants.all            = times.all;
        if (!times.of_extremes)
          instants.followed.clear();
        for (const double t : times.instants(steps.period()))
          instants.chosen.insert(steps.instant(steps.nearest(t)));
        add(std::make_unique<FieldWriter<dim>>(
          body, recovery, steps, instants, checkpoints.directory, log));
      }
    if (scene.output.load_work)
      // Work of the loads ∫ loads · u (force times length, per thickness in a
      // plane). For an elastic body without gap, half of it is the strain
      // energy, and minus this half the least potential energy, the reference
      // for errors in the energy norm.
      add(std::make_unique<SampleTable>(
        table("load_work.csv", {"t", "load_work"}),
        [this](const Sample &sample) -> std::vector<double> {
          const double t = steps.within_period(sample.instant);
          return {sample.time, loads_at(body, t) * sample.state.displacement};
        }));
    if (scene.output.stress_record)
      add(std::make_unique<StressWriter<dim>>(body,
                                              checkpoints.directory +
                                                "/stress_samples.bin"));
    add(std::make_unique<PeriodTable>(table("periods.csv",
                                            {"period",
                                             "t_end",
                                             "stress_change",
                                             "stress_error_estimate",
                                             "vi_solves",
                                             "seconds"}),
                                      scene,
                                      extremes->lip,
                                      log));
    checkpoints.set_tables(names);
  }



  template void
  Run<2>::make_observers();
  template void
  Run<3>::make_observers();
} // namespace Crevasse
